// The rough surface: GGX facets and their height-correlated masking.
// Twin: gltf_iri/optics/microfacet.py.

#include "common/math.glsl"
#include "generated/constants.glsl"

// α = max(perceptual_roughness², ALPHA_MIN)
// glTF 2.0 Appendix B.3
float alpha_ggx(float perceptual_roughness) { return max(sq(perceptual_roughness), ALPHA_MIN); }

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
