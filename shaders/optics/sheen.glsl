// The fibres of a cloth: Charlie's distribution and its fitted masking.
// Twin: gltf_iri/optics/sheen.py.

#include "common/math.glsl"
#include "generated/layer_constants.glsl"

// α = max(sheen_roughness², SHEEN_ALPHA_MIN)
float sheen_alpha(float sheen_roughness) { return max(sq(sheen_roughness), SHEEN_ALPHA_MIN); }

// D = (2 + 1/α) sin^(1/α) θ_h / 2π, sin²θ_h = 1 − (N·H)²
// Estevez & Kulla 2017, "Production Friendly Microfacet Sheen BRDF", Eq. 2
float d_charlie(float n_dot_h, float alpha) {
    float sine_squared = max(1.0 - sq(n_dot_h), 0.0);
    return (2.0 + 1.0 / alpha) / (2.0 * PI) * pow(sine_squared, 0.5 / alpha);
}

// L(x) = a / (1 + b xᶜ) + d x + e
float sheen_exponent(float x, float[5] fit) { return fit[0] / (1.0 + fit[1] * pow(x, fit[2])) + fit[3] * x + fit[4]; }

// Λ = e^L(cosθ) below cosθ = ½, e^(2L(½) − L(1 − cosθ)) above; a … e run from their fit at α = 1 to that at α = 0 as
// (1 − α)². Estevez & Kulla 2017, section 3.
float lambda_sheen(float cos_theta, float alpha) {
    float share = sq(1.0 - alpha);
    float fit[5];
    for (int i = 0; i < 5; ++i) {
        fit[i] = SHEEN_FIT_AT_1[i] + share * (SHEEN_FIT_AT_0[i] - SHEEN_FIT_AT_1[i]);
    }
    float near = sheen_exponent(min(cos_theta, 1.0 - cos_theta), fit);
    return exp(cos_theta < 0.5 ? near : 2.0 * sheen_exponent(0.5, fit) - near);
}

// V = 1 / ((1 + Λ(N·V) + Λ(N·L)) · 4 N·L N·V)
// Estevez & Kulla 2017, section 3
float v_sheen(float n_dot_l, float n_dot_v, float alpha) {
    float masking = 1.0 + lambda_sheen(n_dot_v, alpha) + lambda_sheen(n_dot_l, alpha);
    return 1.0 / (masking * 4.0 * n_dot_l * n_dot_v);
}

// 1 − max(R, G, B)·E
// KHR_materials_sheen, Albedo Scaling
float sheen_weight(vec3 sheen_color, float albedo) { return 1.0 - max3(sheen_color) * albedo; }
