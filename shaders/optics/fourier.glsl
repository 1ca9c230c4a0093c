// The film's Fourier series, integrated over the spectrum term by term.
// Twin: gltf_iri/evaluation/fourier.py, which argues the bound of the terms left out. That integrates resonators of
// nearly perfect mirrors over wavelengths; here they get as many orders as they ask for.

#include "common/math.glsl"
#include "generated/film_constants.glsl"
#include "optics/base.glsl"
#include "optics/film_sensitivity.glsl"
#include "optics/refraction.glsl"
#include "optics/spectral_rule.glsl"

// Light that grazes closer is at its limit to the last bit of float32, and no admittance is exactly 0.
const float GRAZING = 1e-12;

// Frustrated films let through less than float32 knows of 1 long before this, and squares still fit.
const float DEEPEST_RAD = 40.0;

// The admittances of one polarisation; the base's channel by channel, all real. `scale` is q₂/Y₂.
struct Admittances {
    float y1;
    float y2;
    vec3 y3;
    float scale;
};

// What a polarisation keeps from order to order.
struct FilmSeries {
    vec3 entering;  // G/2
    vec3 ratio;     // z
    vec3 tail;      // H/G
};

FilmSeries film_series(Admittances y) {
    float first = y.y1 + y.y2;
    float contrast = y.y1 - y.y2;
    vec3 second = y.y2 + y.y3;
    vec3 whole = y.y1 * second * second + contrast * contrast * y.y3;
    // One division for two: software renderers divide slowly.
    vec3 both = 1.0 / (second * whole);
    vec3 inverse = second * both;
    vec3 ratio = (-contrast / first) * (y.y2 - y.y3) * (whole * both);
    vec3 tail = (1.0 + abs(ratio)) * (0.25 / y.y2 * first * first) * (second * second * inverse);
    return FilmSeries(2.0 * y.y1 * y.y2 * y.y3 * inverse, ratio, tail);
}

// What enters the base at one wavelength, 4 Y₁Y₃ / ((Y₁ + Y₃)² cos²β + (Y₂² + Y₁Y₃)² sin²β/Y₂²): 1 − R for real Y₁, Y₃.
// Belcour & Barla 2017, Eq. 2-3; Airy summation
vec3 entering_airy(Admittances y, float y2_squared, float cosine, float sine_over_q2) {
    vec3 across = (y.y1 + y.y3) * cosine;
    vec3 along = (y2_squared + y.y1 * y.y3) * (y.scale * sine_over_q2);
    return 4.0 * y.y1 * y.y3 / (across * across + along * along);
}

// (cos β, sin β/q₂) of a film with at most a part of a fringe, or frustrated; path_rad = 2π d/λ.
vec2 smooth_wave(float q2_squared, float path_rad) {
    float z = path_rad * path_rad * q2_squared;  // β², negative for a frustrated film
    if (z > -1.0) {
        return vec2(1.0 + z * (-1.0 / 2.0 + z * (1.0 / 24.0 + z * (-1.0 / 720.0 + z / 40320.0))),
                    path_rad * (1.0 + z * (-1.0 / 6.0 + z * (1.0 / 120.0 + z * (-1.0 / 5040.0 + z / 362880.0)))));
    }
    float q2 = sqrt(-q2_squared);
    float grown = exp(min(path_rad * q2, DEEPEST_RAD));
    return 0.5 * vec2(grown + 1.0 / grown, (grown - 1.0 / grown) / q2);
}

// Adds an order, of which the powers are 2 · G/2 · z^m, and moves them on; whether the next one counts.
bool add_order(
    FilmSeries s, FilmSeries p, float order_nm, inout vec3 power_s, inout vec3 power_p, inout vec3 entering) {
    vec4 sensitivity = sensitivity_real(sensitivity_place(order_nm));
    vec3 left = abs(power_s) * s.tail + abs(power_p) * p.tail;
    entering += (power_s + power_p) * clamp(left * sensitivity.a - 1.0, 0.0, 1.0) * sensitivity.rgb;
    power_s *= s.ratio;
    power_p *= p.ratio;
    // The envelope never rises: what this order's leaves below 1 need not be looked up.
    return max3(abs(power_s) * s.tail + abs(power_p) * p.tail) * sensitivity.a > 1.0;
}

// R_j = 1 − Σ_{s,p} G/2 (1 + 2 Σ_m Re(z^m Ŝ_j(m D))), D = 2 d q₂
// Belcour & Barla 2017, Eq. 5-6 and 10
vec3 film_colour_fourier(
    float outside_ior, float film_ior, vec3 n3, vec3 q3_squared, float thickness_nm, float cos_theta_1) {
    float q1 = outside_ior * cos_theta_1;
    float q2_squared = normal_index_squared(film_ior, outside_ior, cos_theta_1);
    float root = sqrt(max(q2_squared, 0.0));
    float opd_nm = 2.0 * thickness_nm * root;
    bool has_fringes = opd_nm > FOURIER_THIN_OPD_NM;
    // 1 keeps a series finite that no one asks for.
    float q2 = has_fringes ? root : 1.0;
    // What a real base reflects in total enters it nowhere, whatever its phase: Re q₃ = 0 says so.
    vec3 q3 = sqrt(max(q3_squared, 0.0));
    // Common factors of the admittances cancel; so written, only the base's index is divided by.
    float one = outside_ior * outside_ior, two = film_ior * film_ior;
    Admittances y_s = Admittances(q1, q2, q3, 1.0);
    Admittances y_p = Admittances(q1 * two, q2 * one, q3 * (one * two / (n3 * n3)), 1.0 / one);

    // A loop that is left at once, not a branch: software renderers compute both sides of a branch.
    vec3 entering = vec3(0.0);
    for (int i = 0; i < SPECTRAL_SMOOTH_COUNT; ++i) {
        if (has_fringes) {
            break;
        }
        vec4 node = smooth_node(i);
        vec2 wave = smooth_wave(q2_squared, 2.0 * PI * thickness_nm * node.a);
        vec3 both = entering_airy(y_s, q2_squared, wave.x, wave.y) +
                    entering_airy(y_p, q2_squared * one * one, wave.x, wave.y);
        entering += 0.5 * node.rgb * both;
    }
    FilmSeries s = film_series(y_s), p = film_series(y_p);
    entering = has_fringes ? s.entering + p.entering : entering;
    vec3 power_s = has_fringes ? 2.0 * s.entering * s.ratio : vec3(0.0);
    vec3 power_p = has_fringes ? 2.0 * p.entering * p.ratio : vec3(0.0);
    // The first two are looked up for every film; of the second nothing counts where none is left after the first.
    add_order(s, p, opd_nm, power_s, power_p, entering);
    // The table ends before the orders do, and with it the bound: each moves on by more than FOURIER_THIN_OPD_NM.
    // Left at the end, not at the start: software renderers run what follows once more for nobody.
    for (int m = 2; m <= FOURIER_ORDERS; ++m) {
        if (!add_order(s, p, float(m) * opd_nm, power_s, power_p, entering)) {
            break;
        }
    }
    return 1.0 - entering;
}

// base_f0 : the base's reflectance at normal incidence under air, from which each channel gets one real index.
vec3 iridescent_fresnel_fourier(
    float outside_ior, float film_ior, vec3 base_f0, float thickness_nm, float cos_theta_1) {
    float cosine = max(cos_theta_1, GRAZING);
    Base red = base_of_f0(base_f0.r), green = base_of_f0(base_f0.g), blue = base_of_f0(base_f0.b);
    vec3 q3_squared = vec3(base_normal_index_squared(red, outside_ior, cosine).x,
                           base_normal_index_squared(green, outside_ior, cosine).x,
                           base_normal_index_squared(blue, outside_ior, cosine).x);
    q3_squared *= 1.0 - vec3(red.is_mirror, green.is_mirror, blue.is_mirror);
    vec3 n3 = vec3(red.n, green.n, blue.n);
    return film_colour_fourier(outside_ior, film_ior, n3, q3_squared, thickness_nm, cosine);
}
