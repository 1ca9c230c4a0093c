// The film of KHR_materials_iridescence, to the letter.
// Twin: gltf_iri/evaluation/khr.py. What the text leaves undefined (F0 + 0.0001 at and above 1) stays undefined here.

#include "common/math.glsl"
#include "generated/film_constants.glsl"
#include "optics/fresnel.glsl"
#include "optics/ior.glsl"
#include "optics/refraction.glsl"
#include "optics/sensitivity.glsl"

// R = max(0, C0 + Σ_{m=1}^{2} Cm 2 S(m D, m φ)), Cm = (Rs − T121) r123^m, C0 = R12 + Rs, D = 2 n₂ d cosθ₂
// KHR_materials_iridescence, Implementation Notes, Iridescence Fresnel
vec3 iridescent_fresnel_khr(
    float outside_ior, float film_ior, vec3 base_f0, float thickness_nm, float cos_theta_1) {
    float cos_2_squared = cos_theta_2_squared(outside_ior, film_ior, cos_theta_1);
    if (cos_2_squared < 0.0) {
        return vec3(1.0);
    }
    float cos_theta_2 = sqrt(cos_2_squared);

    // Outside to film.
    float R12 = f_schlick(ior_to_fresnel0(film_ior, outside_ior), cos_theta_1);
    float T121 = 1.0 - R12;
    float phi21 = film_ior < outside_ior ? 0.0 : PI;

    // Film to base.
    vec3 base_ior = fresnel0_to_ior(base_f0 + F0_OFFSET);
    vec3 R23 = f_schlick(ior_to_fresnel0(base_ior, film_ior), cos_theta_2);
    vec3 phi = phi21 + PI * vec3(lessThan(base_ior, vec3(film_ior)));

    // The floor keeps √ away from 0, the ceiling the geometric series from its pole.
    vec3 R123 = clamp(R12 * R23, R123_MIN, R123_MAX);
    vec3 r123 = sqrt(R123);
    vec3 Rs = sq(T121) * R23 / (1.0 - R123);

    float opd_nm = 2.0 * film_ior * thickness_nm * cos_theta_2;
    vec3 I = R12 + Rs;
    vec3 Cm = Rs - T121;
    for (int m = 1; m <= 2; ++m) {
        Cm *= r123;
        I += Cm * 2.0 * eval_sensitivity(float(m) * opd_nm, float(m) * phi);
    }
    return max(I, vec3(0.0));
}
