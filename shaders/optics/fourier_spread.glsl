// The film's Fourier series averaged over a Gaussian spread of thickness: a film whose thickness varies in a pixel.
// Twin: gltf_iri/evaluation/prefiltered.py. Belcour & Barla 2017, section 5, Multi-scale Rendering.

#include "common/math.glsl"
#include "generated/film_constants.glsl"
#include "optics/film_sensitivity_spread.glsl"
#include "optics/film_series.glsl"
#include "optics/film_smooth.glsl"

// Thin films, and frustrated ones, are averaged by a trapezoidal rule: 5.6 standard deviations on either side.
const int THIN_SIDE = 8;
const float THIN_STEP = 0.7;

// R_j = 1 − Σ_{s,p} G/2 (1 + 2 Σ_m Re(z^m Ŝ_j(m D, m s))), D = 2 d q₂, s = 2 σ q₂
// base_f0 : the base's reflectance at normal incidence under air, from which each channel gets one real index.
// thickness_std_nm : σ; what it puts below thickness 0 counts as the film that is as thick above.
vec3 iridescent_fresnel_fourier_spread(
    float outside_ior, float film_ior, vec3 base_f0, float thickness_nm, float thickness_std_nm, float cos_theta_1) {
    FilmAdmittances film = film_admittances(outside_ior, film_ior, base_f0, cos_theta_1);
    float opd_nm = 2.0 * thickness_nm * film.s.y2;
    float opd_std_nm = 2.0 * thickness_std_nm * film.s.y2;
    bool has_fringes = max(opd_nm, opd_std_nm) > FOURIER_THIN_OPD_NM;
    vec3 without_fringes = vec3(0.0);
    for (int k = -THIN_SIDE; k <= THIN_SIDE; ++k) {
        if (has_fringes) {
            break;
        }
        float place = THIN_STEP * float(k);
        float weight = THIN_STEP / sqrt(2.0 * PI) * exp(-0.5 * sq(place));
        float thickness = abs(thickness_nm + place * thickness_std_nm);
        without_fringes += weight * smooth_entering(film, thickness, has_fringes);
    }
    FilmOrders orders = film_orders(film, has_fringes, without_fringes);
    // As in fourier.glsl: the first two for every film, and no further order without a bound that asks for it.
    add_order(orders, sensitivity_spread(opd_nm, opd_std_nm));
    for (int m = 2; m <= FOURIER_ORDERS; ++m) {
        if (!add_order(orders, sensitivity_spread(float(m) * opd_nm, float(m) * opd_std_nm))) {
            break;
        }
    }
    return 1.0 - orders.entering;
}
