// The film's Fourier series, integrated over the spectrum term by term.
// Twin: gltf_iri/evaluation/fourier.py, which argues the bound of the terms left out. That integrates resonators of
// nearly perfect mirrors over wavelengths; here they get as many orders as they ask for.

#include "generated/film_constants.glsl"
#include "optics/film_sensitivity.glsl"
#include "optics/film_series.glsl"
#include "optics/film_smooth.glsl"

// R_j = 1 − Σ_{s,p} G/2 (1 + 2 Σ_m Re(z^m Ŝ_j(m D))), D = 2 d q₂
// Belcour & Barla 2017, Eq. 5-6 and 10
// base_f0 : the base's reflectance at normal incidence under air, from which each channel gets one real index.
vec3 iridescent_fresnel_fourier(
    float outside_ior, float film_ior, vec3 base_f0, float thickness_nm, float cos_theta_1) {
    FilmAdmittances film = film_admittances(outside_ior, film_ior, base_f0, cos_theta_1);
    float opd_nm = 2.0 * thickness_nm * film.s.y2;
    bool has_fringes = opd_nm > FOURIER_THIN_OPD_NM;
    vec3 without_fringes = smooth_entering(film, thickness_nm, has_fringes);
    FilmOrders orders = film_orders(film, has_fringes, without_fringes);
    // The first two are looked up for every film; of the second nothing counts where none is left after the first.
    add_order(orders, sensitivity_real(sensitivity_place(opd_nm)));
    // The table ends before the orders do, and with it the bound: each moves on by more than FOURIER_THIN_OPD_NM.
    // Left at the end, not at the start: software renderers run what follows once more for nobody.
    for (int m = 2; m <= FOURIER_ORDERS; ++m) {
        if (!add_order(orders, sensitivity_real(sensitivity_place(float(m) * opd_nm)))) {
            break;
        }
    }
    return 1.0 - orders.entering;
}
