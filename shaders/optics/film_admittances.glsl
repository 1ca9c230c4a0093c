// What light enters and leaves at a film's two interfaces, over a real base.
// Twin: gltf_iri/optics/film_series.py, and gltf_iri/optics/incoherent.py.

#include "optics/base.glsl"
#include "optics/refraction.glsl"

// Light that grazes closer is at its limit to the last bit of float32, and no admittance outside is exactly 0.
const float GRAZING = 1e-12;

// The admittances of one polarisation; the base's channel by channel, all real. `scale` is q₂/Y₂.
struct Admittances {
    float y1;
    float y2;
    vec3 y3;
    float scale;
};

// A film in both polarisations. `inside` is n₁⁴, the square of Y₂/q₂ of p.
struct FilmAdmittances {
    Admittances s;
    Admittances p;
    float q2_squared;  // (n₂ cosθ₂)², negative where the film is frustrated
    float inside;
};

// base_f0 : the base's reflectance at normal incidence under air, from which each channel gets one real index. Of
// vec3(x), a grey base, compilers find that all channels are one.
FilmAdmittances film_admittances(float outside_ior, float film_ior, vec3 base_f0, float cos_theta_1) {
    float cosine = max(cos_theta_1, GRAZING);
    Base red = base_of_f0(base_f0.r), green = base_of_f0(base_f0.g), blue = base_of_f0(base_f0.b);
    vec3 q3_squared = vec3(base_normal_index_squared(red, outside_ior, cosine).x,
                           base_normal_index_squared(green, outside_ior, cosine).x,
                           base_normal_index_squared(blue, outside_ior, cosine).x);
    q3_squared *= 1.0 - vec3(red.is_mirror, green.is_mirror, blue.is_mirror);
    vec3 n3 = vec3(red.n, green.n, blue.n);
    FilmAdmittances f;
    float q1 = outside_ior * cosine;
    f.q2_squared = normal_index_squared(film_ior, outside_ior, cosine);
    float q2 = sqrt(max(f.q2_squared, 0.0));
    // What a real base reflects in total enters it nowhere, whatever its phase: Re q₃ = 0 says so.
    vec3 q3 = sqrt(max(q3_squared, 0.0));
    // Common factors of the admittances cancel; so written, only the base's index is divided by.
    float one = outside_ior * outside_ior, two = film_ior * film_ior;
    f.s = Admittances(q1, q2, q3, 1.0);
    f.p = Admittances(q1 * two, q2 * one, q3 * (one * two / (n3 * n3)), 1.0 / one);
    f.inside = one * one;
    return f;
}
