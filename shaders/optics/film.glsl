// The exact reflectance of one thin film at one wavelength: every inter-reflection, both polarisations.
// Twin: gltf_iri/optics/film.py. Where that divides by cos β, this does not: tan β is beyond float32 near its pole.

#include "common/complex.glsl"
#include "common/math.glsl"
#include "optics/base.glsl"
#include "optics/refraction.glsl"

// One polarisation, R = |N₀ cos β + i N₁ sin β/q₂|² / |D₀ cos β − i D₁ sin β/q₂|². In each vec2 the factor of cos β,
// then that of sin β/q₂.
struct FilmPolarisation {
    vec2 num_real;
    vec2 num_imag;
    vec2 den_real;
    vec2 den_imag;
};

// Admittances Y = q (s) and q/n² (p) of outside, film and base; `scale` is q₂/Y₂.
FilmPolarisation film_polarisation(float y1, float y2_squared, vec2 y3, float scale) {
    FilmPolarisation p;
    p.num_real = vec2(y1 - y3.x, scale * y1 * y3.y);
    p.num_imag = vec2(-y3.y, scale * (y2_squared - y1 * y3.x));
    p.den_real = vec2(y1 + y3.x, scale * y1 * y3.y);
    p.den_imag = vec2(y3.y, -scale * (y2_squared + y1 * y3.x));
    return p;
}

float film_reflectance(FilmPolarisation p, vec2 wave) {
    float numerator = sq(dot(p.num_real, wave)) + sq(dot(p.num_imag, wave));
    float denominator = sq(dot(p.den_real, wave)) + sq(dot(p.den_imag, wave));
    // Both vanish only where all three media match at grazing: then nothing reflects. |N| ≤ |D| up to rounding.
    return denominator > 0.0 ? min(numerator / denominator, 1.0) : 0.0;
}

struct FilmInterfaces {
    FilmPolarisation s;
    FilmPolarisation p;
    bool is_mirror;
};

FilmInterfaces film_interfaces(float outside_ior, float film_ior, Base base, float cos_theta_1) {
    FilmInterfaces f;
    f.is_mirror = base.is_mirror;
    vec2 n3 = vec2(base.n, base.k);
    float q1 = outside_ior * cos_theta_1;
    float q2_squared = normal_index_squared(film_ior, outside_ior, cos_theta_1);
    vec2 q3 = complex_root(base_normal_index_squared(base, outside_ior, cos_theta_1));
    f.s = film_polarisation(q1, q2_squared, q3, 1.0);
    float n2_squared = sq(film_ior);
    vec2 y3 = complex_quotient(complex_quotient(q3, n3), n3);
    f.p = film_polarisation(cos_theta_1 / outside_ior, q2_squared / sq(n2_squared), y3, n2_squared);
    return f;
}

// The light's way through the film at one angle.
struct FilmPath {
    float q2_squared;
    float q2;
    float thickness_nm;
    vec2 double_path_nm;  // 2 d q₂ in two parts, the first of twelve bits; 0 where q₂ is imaginary
};

FilmPath film_path(float outside_ior, float film_ior, float thickness_nm, float cos_theta_1) {
    vec2 parts = normal_index_squared_parts(film_ior, 0.0, outside_ior, cos_theta_1);
    FilmPath path;
    path.q2_squared = parts.x + parts.y;
    path.q2 = sqrt(abs(path.q2_squared));
    path.thickness_nm = thickness_nm;
    path.double_path_nm = vec2(0.0);
    if (path.q2_squared > 0.0) {
        // Narrow resonances see what float32 rounds off the root and off its product with d.
        vec2 q2 = halves(path.q2);
        vec2 d = halves(2.0 * thickness_nm);
        vec2 squared = square_of_halves(q2);
        float rest_of_q2 = 0.5 * (((parts.x - squared.x) - squared.y) + parts.y) / path.q2;
        float product = q2.x * d.x;
        float rest = (q2.x * d.y + q2.y * d.x) + (q2.y * d.y + rest_of_q2 * (2.0 * thickness_nm));
        path.double_path_nm.x = halves(product + rest).x;
        path.double_path_nm.y = (product - path.double_path_nm.x) + rest;
    }
    return path;
}

// 1/λ in two parts, the first of twelve bits, and what float32 rounds off the quotient: products of halves are exact.
vec2 wavenumber_parts(float wavelength_nm) {
    vec2 wavelength = halves(wavelength_nm);
    vec2 wavenumber = halves(1.0 / wavelength_nm);
    float rest = ((1.0 - wavelength.x * wavenumber.x) - wavelength.y * wavenumber.x) - wavelength.x * wavenumber.y;
    wavenumber.y += (rest - wavelength.y * wavenumber.y) / wavelength_nm;
    return wavenumber;
}

// (cos β, sin β/q₂) for β = 2π d q₂/λ, and for a frustrated film, whose q₂ is imaginary, both over cosh |β|.
// wavenumber : 1/λ in two parts, the first of twelve bits, 1/nm
vec2 film_wave(FilmPath path, vec2 wavenumber) {
    float path_rad = 2.0 * PI * path.thickness_nm * (wavenumber.x + wavenumber.y);
    float z = sq(path_rad) * path.q2_squared;  // β², negative for a frustrated film
    if (abs(z) < 1.0) {
        // Taylor: near the critical angle, drivers' sin and tanh keep too few digits of a small angle over a small q₂.
        float cosine = 1.0 + z * (-1.0 / 2.0 + z * (1.0 / 24.0 + z * (-1.0 / 720.0 + z * (1.0 / 40320.0 -
                       z / 3628800.0))));
        float sine = 1.0 + z * (-1.0 / 6.0 + z * (1.0 / 120.0 + z * (-1.0 / 5040.0 + z / 362880.0)));
        return vec2(cosine, path_rad * sine);
    }
    if (z < 0.0) {
        // Beyond 10 tanh is 1 in float32, and some drivers' exponentials overflow further out.
        return vec2(1.0, tanh(min(path_rad * path.q2, 10.0)) / path.q2);
    }
    // Whole half turns only change the sign of both; taken off before π is multiplied in, they cost no digits. The
    // product of the first parts is exact.
    vec2 p = path.double_path_nm;
    float half_turns = p.x * wavenumber.x;
    half_turns -= floor(half_turns + 0.5);
    float beta = PI * (half_turns + (p.x * wavenumber.y + p.y * (wavenumber.x + wavenumber.y)));
    return vec2(cos(beta), sin(beta) / path.q2);
}

// The mean of R_s and R_p.
float film_reflectance(FilmInterfaces f, vec2 wave) {
    return f.is_mirror ? 1.0 : 0.5 * (film_reflectance(f.s, wave) + film_reflectance(f.p, wave));
}

// At one wavelength, over a base of index n + ik.
float film_reflectance(
    float outside_ior, float film_ior, float base_n, float base_k, float thickness_nm, float wavelength_nm,
    float cos_theta_1) {
    FilmInterfaces f = film_interfaces(outside_ior, film_ior, base_of_index(base_n, base_k), cos_theta_1);
    FilmPath path = film_path(outside_ior, film_ior, thickness_nm, cos_theta_1);
    return film_reflectance(f, film_wave(path, wavenumber_parts(wavelength_nm)));
}
