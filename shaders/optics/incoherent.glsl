// The film's reflectance averaged over its phase: what stays where fringes are finer than can be seen.
// Twin: gltf_iri/optics/incoherent.py.

#include "optics/base.glsl"
#include "optics/refraction.glsl"

// Light that grazes closer is at its limit to the last bit of float32, and no admittance but the base's is exactly 0.
const float FLATTEST = 1e-12;

// G/2 = 2 Y₁Y₂Y₃ / ((Y₁ + Y₃)(Y₂² + Y₁Y₃)) of one polarisation, all admittances real
// Belcour & Barla 2017, Eq. 5-6, the order m = 0
vec3 half_entering(float y1, float y2, vec3 y3) {
    return 2.0 * y1 * y2 * y3 / ((y1 + y3) * (y2 * y2 + y1 * y3));
}

// base_f0 : the base's reflectance at normal incidence under air, from which each channel gets one real index.
// The thickness plays no part.
vec3 iridescent_fresnel_incoherent(
    float outside_ior, float film_ior, vec3 base_f0, float thickness_nm, float cos_theta_1) {
    float cosine = max(cos_theta_1, FLATTEST);
    Base red = base_of_f0(base_f0.r), green = base_of_f0(base_f0.g), blue = base_of_f0(base_f0.b);
    vec3 q3_squared = vec3(base_normal_index_squared(red, outside_ior, cosine).x,
                           base_normal_index_squared(green, outside_ior, cosine).x,
                           base_normal_index_squared(blue, outside_ior, cosine).x);
    q3_squared *= 1.0 - vec3(red.is_mirror, green.is_mirror, blue.is_mirror);
    vec3 n3 = vec3(red.n, green.n, blue.n);
    float q1 = outside_ior * cosine;
    // A frustrated film stands for a thick one, which lets nothing through.
    float q2 = max(sqrt(max(normal_index_squared(film_ior, outside_ior, cosine), 0.0)), FLATTEST);
    // What a real base reflects in total enters it nowhere: Re q₃ = 0 says so.
    vec3 q3 = sqrt(max(q3_squared, 0.0));
    float one = outside_ior * outside_ior, two = film_ior * film_ior;
    vec3 entering = half_entering(q1, q2, q3) + half_entering(q1 * two, q2 * one, q3 * (one * two / (n3 * n3)));
    return max(1.0 - entering, 0.0);  // a last bit below 0 is rounding, where nothing is reflected
}
