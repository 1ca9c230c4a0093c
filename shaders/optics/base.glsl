// The medium under a film, for one channel: its index n + ik, from a reflectance or as it is.
// Twin: gltf_iri/evaluation/film.py.

#include "common/math.glsl"
#include "optics/ior.glsl"
#include "optics/refraction.glsl"

// Indices beyond these reflect everything: squares of n and of 1/n² still fit float32.
const float BASE_INDEX_MAX = 1e8;
const float BASE_INDEX_MIN = 1e-6;

struct Base {
    float n;
    float rest_of_n;  // what float32 rounds off n: where the outside's index is the base's, grazing light sees it
    float k;
    bool is_mirror;  // reflects everything; n is then 1, a number to calculate with
};

Base base_of_index(float n, float k) {
    float size = max(n, k);
    bool is_mirror = !(size >= BASE_INDEX_MIN && size <= BASE_INDEX_MAX);
    return Base(is_mirror ? 1.0 : n, 0.0, is_mirror ? 0.0 : k, is_mirror);
}

// n = (1 + √F0)² / (1 − F0) in twice float32's digits: the residues of the root and of the quotient are exact but for
// their own rounding. KHR_materials_iridescence, Material Interfaces. The clamp keeps interpolated textures in range.
Base base_of_f0(float f0) {
    float reflectance = clamp(f0, 0.0, 1.0);
    Base base = base_of_index(reflectance < 1.0 ? fresnel0_to_ior(reflectance) : 2.0 * BASE_INDEX_MAX, 0.0);
    if (base.is_mirror || reflectance == 0.0) {
        return base;
    }
    float root = sqrt(reflectance);
    vec2 squared = square_of_halves(halves(root));
    float rest_of_root = 0.5 * ((reflectance - squared.x) - squared.y) / root;

    // Leading halves are masked, not rounded: compilers know that (1 + x) − 1 is x and a b + a c is a (b + c), and
    // would take the residues for 0. Of the difference, some 12 bits long, the mask takes nothing.
    vec2 sum = vec2(halves(1.0 + root).x, 0.0);
    sum.y = (root - (sum.x - 1.0)) + rest_of_root;
    vec2 difference = vec2(halves(1.0 - reflectance).x, 0.0);
    difference.y = (1.0 - difference.x) - reflectance;
    vec2 n = halves(base.n);
    uint leading = floatBitsToUint(sum.x * sum.x - n.x * difference.x) & 0xFFFFFFF0u;
    float rest = (2.0 * sum.x + sum.y) * sum.y - (base.n * difference.y + n.y * difference.x);
    base.rest_of_n = (uintBitsToFloat(leading) + rest) / (1.0 - reflectance);
    return base;
}

// q² = (n cosθ)² in the base. Where n² and n₁² sin²θ₁ cancel, either k² is small, or 2nk makes q² great.
vec2 base_normal_index_squared(Base base, float outside_ior, float cos_theta_1) {
    vec2 parts = normal_index_squared_parts(base.n, base.rest_of_n, outside_ior, cos_theta_1);
    return vec2(parts.x + parts.y - sq(base.k), 2.0 * base.n * base.k);
}
