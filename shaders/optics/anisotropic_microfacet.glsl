// The rough surface whose slopes are wider along the tangent T than along the bitangent B.
// Twin: gltf_iri/optics/microfacet.py.

#include "common/math.glsl"

// (α_t, α_b) = (mix(α, 1, strength²), α)
// KHR_materials_anisotropy
vec2 anisotropic_alphas(float alpha, float strength) { return vec2(mix(alpha, 1.0, sq(strength)), alpha); }

// D = 1 / (π α_t α_b ((T·H)²/α_t² + (B·H)²/α_b² + (N·H)²)²)
// Burley 2012, "Physically Based Shading at Disney", Eq. 13; written as α_t α_b / (π (…)²), with 1 − (T·H)² − (B·H)²
// in place of (N·H)²: at α_t = α_b it is d_ggx.
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
