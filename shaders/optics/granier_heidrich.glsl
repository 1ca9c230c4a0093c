// The layered surface of Granier & Heidrich 2003, "A Simple Layered RGB BRDF Model".
// Twin: gltf_iri/optics/granier_heidrich.py, which says what the model leaves out.

#include "common/math.glsl"
#include "generated/film_constants.glsl"
#include "optics/turns.glsl"

// One channel of ρ = R + T + 2 cos(2Φ) √(RT)
// R = F(l·n₀) ⟨r, v⟩^e₀ (Eq. 6), T = (1 − F(l·n₀)) 𝒯(t_v) ⟨r_t, −t_v⟩^e₁ (Eq. 10), Φ = π n d ⟨t_l + t_v, −n₀⟩/λ (Eq. 3)
float layered_reflection_channel(
    vec3 light, vec3 view, vec3 normal_0, vec3 normal_1, float outside_ior, float layer_ior, float thickness_nm,
    float exponent_0, float exponent_1, float wavelength_nm) {
    float cos_l = dot(light, normal_0);
    float outer_lobe = pow(max(dot(reflect(-light, normal_0), view), 0.0), exponent_0);
    float ratio = outside_ior / layer_ior;
    float inside_l = 1.0 - sq(ratio) * (1.0 - sq(cos_l));
    float inside_v = 1.0 - sq(ratio) * (1.0 - sq(dot(view, normal_0)));
    if (inside_l < 0.0 || inside_v < 0.0) {
        return outer_lobe;  // the layer lets no light in
    }
    float f = sq((outside_ior - layer_ior) / (outside_ior + layer_ior));
    float F = f + (1.0 - f) * pow5(1.0 - cos_l);
    float R = F * outer_lobe;

    vec3 t_l = -ratio * light + (ratio * cos_l - sqrt(inside_l)) * normal_0;
    vec3 t_v = -ratio * view + (ratio * dot(view, normal_0) - sqrt(inside_v)) * normal_0;
    float inner_lobe = -dot(reflect(t_l, normal_1), t_v);
    float cos_v = -dot(t_v, normal_0);
    float T = 0.0;
    // Eq. 11: rays that the inner boundary does not meet, or sends away from the viewer, bring nothing.
    if (dot(t_l, normal_1) < 0.0 && dot(t_v, normal_1) < 0.0 && inner_lobe > 0.0) {
        T = (1.0 - F) * (1.0 - f) * (1.0 - pow5(1.0 - cos_v)) * pow(inner_lobe, exponent_1);
    }
    float turns = layer_ior * thickness_nm * (cos_v - dot(t_l, normal_0)) / wavelength_nm;
    return R + T + 2.0 * cos_turns(vec3(turns), vec3(0.0)).x * sqrt(R * T);
}

// ρ of all three channels, each with its own index (Eq. 5)
vec3 layered_reflection(
    vec3 light, vec3 view, vec3 normal_0, vec3 normal_1, float outside_ior, vec3 layer_ior, float thickness_nm,
    float exponent_0, float exponent_1) {
    vec3 colour = vec3(0.0);
    for (int channel = 0; channel < 3; ++channel) {
        colour[channel] = layered_reflection_channel(
            light, view, normal_0, normal_1, outside_ior, layer_ior[channel], thickness_nm, exponent_0, exponent_1,
            LAYER_WAVELENGTHS_NM[channel]);
    }
    return colour;
}

// ρ_d = 1 + 2 cos(4π n d/λ) √(T_d (1 − T_d)), T_d = 80 r₀r₁ / 21 (r₁ + r₀)²
// Eq. 15, 18
vec3 layered_diffuse(float outside_ior, vec3 layer_ior, float thickness_nm) {
    vec3 T_d = 80.0 / 21.0 * outside_ior * layer_ior / sq(layer_ior + outside_ior);
    vec3 fringe = cos_turns(2.0 * layer_ior * thickness_nm / LAYER_WAVELENGTHS_NM, vec3(0.0));
    return 1.0 + 2.0 * fringe * sqrt(T_d * (1.0 - T_d));
}

// n₁ = (n₀ + ∂d/∂x t + ∂d/∂y b) / |…|, the inner boundary where it follows the layer's thickness (section 6)
vec3 inner_normal(vec3 normal_0, vec3 tangent, vec3 bitangent, float slope_x, float slope_y) {
    return normalize(normal_0 + slope_x * tangent + slope_y * bitangent);
}

// The model at the mirror direction, parallel boundaries, lobes of 1; the base plays no part
vec3 iridescent_fresnel_granier_heidrich(
    float outside_ior, float film_ior, vec3 base_f0, float thickness_nm, float cos_theta_1) {
    vec3 up = vec3(0.0, 0.0, 1.0);
    vec3 light = vec3(sqrt(1.0 - sq(cos_theta_1)), 0.0, cos_theta_1);
    return layered_reflection(
        light, reflect(-light, up), up, up, outside_ior, vec3(film_ior), thickness_nm, 1.0, 1.0);
}
