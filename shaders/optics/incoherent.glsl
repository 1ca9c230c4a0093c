// The film's reflectance averaged over its phase: what stays where fringes are finer than can be seen.
// Twin: gltf_iri/optics/incoherent.py.

#include "optics/film_admittances.glsl"

// G/2 = 2 Y₁Y₂Y₃ / ((Y₁ + Y₃)(Y₂² + Y₁Y₃)) of one polarisation, all admittances real
// Belcour & Barla 2017, Eq. 5-6, the order m = 0
vec3 half_entering(Admittances y) {
    float y2 = max(y.y2, GRAZING);  // of no film, so that nothing is 0/0 where the base takes no light either
    return 2.0 * y.y1 * y2 * y.y3 / ((y.y1 + y.y3) * (y2 * y2 + y.y1 * y.y3));
}

// base_f0 : the base's reflectance at normal incidence under air, from which each channel gets one real index.
// The thickness plays no part; a frustrated film stands for a thick one, which lets nothing through.
vec3 iridescent_fresnel_incoherent(
    float outside_ior, float film_ior, vec3 base_f0, float thickness_nm, float cos_theta_1) {
    FilmAdmittances film = film_admittances(outside_ior, film_ior, base_f0, cos_theta_1);
    vec3 entering = half_entering(film.s) + half_entering(film.p);
    return max(1.0 - entering, 0.0);  // a last bit below 0 is rounding, where nothing is reflected
}
