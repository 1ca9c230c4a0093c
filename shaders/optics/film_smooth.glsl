// Films with at most a part of a fringe, and frustrated ones: a few wavelengths resolve their spectra.
// Twin: gltf_iri/optics/film.py.

#include "common/math.glsl"
#include "generated/film_constants.glsl"
#include "optics/film_admittances.glsl"
#include "optics/spectral_rule.glsl"

// Frustrated films let through less than float32 knows of 1 long before this, and squares still fit.
const float DEEPEST_RAD = 40.0;

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

// What enters the base of such a film, summed over a few wavelengths; 0 where `has_fringes`.
// A loop that is left at once, not a branch: software renderers compute both sides of a branch.
vec3 smooth_entering(FilmAdmittances f, float thickness_nm, bool has_fringes) {
    vec3 entering = vec3(0.0);
    for (int i = 0; i < SPECTRAL_SMOOTH_COUNT; ++i) {
        if (has_fringes) {
            break;
        }
        vec4 node = smooth_node(i);
        vec2 wave = smooth_wave(f.q2_squared, 2.0 * PI * thickness_nm * node.a);
        vec3 both = entering_airy(f.s, f.q2_squared, wave.x, wave.y) +
                    entering_airy(f.p, f.q2_squared * f.inside, wave.x, wave.y);
        entering += 0.5 * node.rgb * both;
    }
    return entering;
}
