// The rough surface: GGX facets and their height-correlated masking.
// Twin: gltf_iri/optics/microfacet.py.

#include "common/math.glsl"

// D = α² / (π (sin²θ_h + α² cos²θ_h)²), sin²θ_h = |N×H|²
// glTF 2.0 Appendix B.3; |N×H|² in place of 1 − (N·H)², of which float32 keeps three digits at α = 0.01.
float d_ggx(float n_cross_h_squared, float alpha) {
    float a2 = sq(alpha);
    float spread = n_cross_h_squared + a2 * (1.0 - n_cross_h_squared);
    return a2 / (PI * sq(spread));
}

// V = ½ / (N·L √(α² + (1 − α²)(N·V)²) + N·V √(α² + (1 − α²)(N·L)²))
// Heitz 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", Eq. 72 and 99
float v_smith_ggx_correlated(float n_dot_l, float n_dot_v, float alpha) {
    float a2 = sq(alpha);
    float light_term = n_dot_l * sqrt(a2 + (1.0 - a2) * sq(n_dot_v));
    float view_term = n_dot_v * sqrt(a2 + (1.0 - a2) * sq(n_dot_l));
    return 0.5 / (light_term + view_term);
}

// (α_t, α_b) = (mix(α, 1, strength²), α)
// KHR_materials_anisotropy
vec2 anisotropic_alphas(float alpha, float strength) { return vec2(mix(alpha, 1.0, sq(strength)), alpha); }

// D = 1 / (π α_t α_b ((T·H)²/α_t² + (B·H)²/α_b² + (N·H)²)²)
// Burley 2012, "Physically Based Shading at Disney", Eq. 13; written as α_t α_b / (π (…)²), with 1 − (T·H)² − (B·H)²
// in place of (N·H)², for the reason above.
float d_ggx_anisotropic(float t_dot_h, float b_dot_h, float alpha_t, float alpha_b) {
    float along = sq(t_dot_h), across = sq(b_dot_h);
    float area = alpha_t * alpha_b;
    float spread = along * (alpha_b / alpha_t) + across * (alpha_t / alpha_b) + area * (1.0 - (along + across));
    return area / (PI * sq(spread));
}

// V = ½ / (N·L √((α_t T·V)² + (α_b B·V)² + (N·V)²) + N·V √((α_t T·L)² + (α_b B·L)² + (N·L)²))
// Heitz 2014, Eq. 99 with Eq. 86's Λ
float v_smith_ggx_anisotropic(float n_dot_l, float n_dot_v, float t_dot_l, float b_dot_l, float t_dot_v,
                              float b_dot_v, float alpha_t, float alpha_b) {
    float light_term = n_dot_l * length(vec3(alpha_t * t_dot_v, alpha_b * b_dot_v, n_dot_v));
    float view_term = n_dot_v * length(vec3(alpha_t * t_dot_l, alpha_b * b_dot_l, n_dot_l));
    return 0.5 / (light_term + view_term);
}
