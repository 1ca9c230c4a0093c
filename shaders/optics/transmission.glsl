// Light through a body: its indices by colour, where and how it leaves, and how wide a rough surface spreads it.
// Twin: gltf_iri/optics/transmission.py.

#include "common/math.glsl"

// Facets that turn a normal by δ bend light by (n − 1) δ at one side of a plate and mirror it by 2 δ. Entry and exit
// are rough: of GGX facets both together have 1.7 times the median of one (of Gaussian ones, 1.4).
const float BOTH_SIDES = 1.7;

// α′ = 1.7 · ½ (n − 1) α, at most 1
float refraction_roughness(float perceptual_roughness, float ior) {
    return sqrt(min(BOTH_SIDES * 0.5 * abs(ior - 1.0) * sq(perceptual_roughness), 1.0));
}

// n − s, n, n + s, s = 0.025 (n − 1) dispersion; KHR_materials_dispersion. Never below 1, where light
// that enters could be totally reflected.
vec3 dispersed_iors(float ior, float dispersion) {
    float half_spread = 0.025 * (ior - 1.0) * dispersion;
    return max(vec3(ior - half_spread, ior, ior + half_spread), 1.0);
}

// Where light leaves a body that is known on one side only. Roundness 1: a ball as thick as the body; 0: a plate; ½ lets
// it leave straight, bent once. d: unit, the way inside; outward normal N (2k − 1) + 2k cosθ d, cosθ = −N·d. Of all,
// the angle inside is at most that of the entry, so nothing is totally reflected.
vec3 exit_normal(vec3 entry_normal, vec3 inside, float roundness) {
    float cos_theta = -dot(entry_normal, inside);
    return normalize(entry_normal * (2.0 * roundness - 1.0) + 2.0 * roundness * cos_theta * inside);
}

// thickness · cosθ^(2k − 1): the chord of a ball, and the slanted way through a plate
float path_inside(float thickness, float cos_theta, float roundness) {
    return thickness * pow(cos_theta, 2.0 * roundness - 1.0);
}
