// Light through a body whose surface is rough: its indices by colour, and how wide the way through spreads it.
// Twin: gltf_iri/optics/transmission.py.

#include "common/math.glsl"

// Facets that turn a normal by δ bend light by (n − 1) δ at one side of a plate and mirror it by 2 δ. Entry and exit
// are rough: of GGX facets the median of both together is 1.7 times that of one (1.4 would be a Gaussian's).
const float BOTH_SIDES = 1.7;

// α′ = 1.7 · ½ (n − 1) α, at most 1
float refraction_roughness(float perceptual_roughness, float ior) {
    return sqrt(min(BOTH_SIDES * 0.5 * abs(ior - 1.0) * sq(perceptual_roughness), 1.0));
}

// n − s, n, n + s, s = 0.025 (n − 1) dispersion; KHR_materials_dispersion, Implementation. Never below 1, where light
// that enters could be totally reflected.
vec3 dispersed_iors(float ior, float dispersion) {
    float half_spread = 0.025 * (ior - 1.0) * dispersion;
    return max(vec3(ior - half_spread, ior, ior + half_spread), 1.0);
}
