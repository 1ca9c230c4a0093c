// The film of KHR_materials_iridescence with its undefined and discontinuous cases closed.
// Twin: gltf_iri/evaluation/khr_guarded.py, which states the constants and argues each guard.

#include "common/math.glsl"
#include "generated/film_constants.glsl"
#include "optics/fresnel.glsl"
#include "optics/ior.glsl"
#include "optics/refraction.glsl"
#include "optics/sensitivity.glsl"

// F = F0 + (F90 − F0)(1 − cosθ)⁵, F90 = min(1, F0 / MATCHED_F0)
// Schlick, whose grazing reflectance fades with the contrast: two equal indices are no interface at any angle.
float f_schlick_matched(float f0, float cos_theta) {
    return f0 + (min(1.0, f0 / MATCHED_F0) - f0) * pow5(1.0 - cos_theta);
}
vec3 f_schlick_matched(vec3 f0, float cos_theta) {
    return f0 + (min(vec3(1.0), f0 / MATCHED_F0) - f0) * pow5(1.0 - cos_theta);
}

// R = clamp(C0 + Σ_{m=1}^{2} Cm 2 S(m D, m φ) / S(0, 0), 0, 1), as in iridescent_fresnel_khr, and for D → 0 the bare
// base under the outside medium
// KHR_materials_iridescence, Iridescence Fresnel; guards in spec/iridescence-notes.md
vec3 iridescent_fresnel_khr_guarded(
    float outside_ior, float film_ior, vec3 base_f0, float thickness_nm, float cos_theta_1) {
    float cos_2_squared = cos_theta_2_squared(outside_ior, film_ior, cos_theta_1);
    if (cos_2_squared < 0.0) {
        return vec3(1.0);
    }
    float cos_theta_2 = sqrt(cos_2_squared);

    // Outside to film.
    float R12 = f_schlick_matched(ior_to_fresnel0(film_ior, outside_ior), cos_theta_1);
    float T121 = 1.0 - R12;
    float phi21 = film_ior < outside_ior ? 0.0 : PI;

    // Film to base; the ceiling keeps the index of a perfect white metal finite.
    vec3 base_ior = fresnel0_to_ior(clamp(base_f0, 0.0, MAX_F0));
    vec3 R23 = f_schlick_matched(ior_to_fresnel0(base_ior, film_ior), cos_theta_2);
    vec3 phi = phi21 + PI * vec3(lessThan(base_ior, vec3(film_ior)));

    // Keeps the geometric series from its pole; without the text's floor, no interface leaves no fringe.
    vec3 R123 = min(R12 * R23, MAX_R123);
    vec3 r123 = sqrt(R123);
    vec3 Rs = sq(T121) * R23 / (1.0 - R123);

    float opd_nm = 2.0 * film_ior * thickness_nm * cos_theta_2;
    vec3 I = R12 + Rs;
    vec3 Cm = Rs - T121;
    for (int m = 1; m <= 2; ++m) {
        Cm *= r123;
        // Divided by their white, fringes tint what the constant term leaves white.
        I += Cm * 2.0 * eval_sensitivity(float(m) * opd_nm, float(m) * phi) / SENSITIVITY_WHITE;
    }

    // A film far thinner than light's waves is not there; two orders of the series overshoot [0, 1] a little.
    vec3 bare = f_schlick(ior_to_fresnel0(base_ior, outside_ior), cos_theta_1);
    return clamp(mix(bare, I, smoothstep(0.0, THIN_OPD_NM, opd_nm)), 0.0, 1.0);
}
