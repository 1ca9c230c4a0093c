// The exact reflectance of a Bragg mirror of lossless cells at one wavelength, both polarisations averaged.
// Twin: gltf_iri/optics/bragg.py. There t = tan ½φ and X = Y₂/Y₁; here ½φ's cosine and sine over q stand for them,
// which stay finite where light runs along a film, and real where it fades in n2.

#include "common/math.glsl"
#include "optics/film.glsl"
#include "optics/refraction.glsl"

// One polarisation: admittances Y = q (s) and q/n² (p), and per film m = 1 (s) and n² (p).
struct BraggPolarisation {
    float y_host;
    float y_1;
    vec2 y_squared;  // of the two films
    float step_up;   // Y₂² − Y₁², as a product
    vec2 m;
};

struct BraggMirror {
    bool is_total;  // light fades in n1, and beyond the mirror
    FilmPath half_path_1;
    FilmPath half_path_2;
    BraggPolarisation s;
    BraggPolarisation p;
    uint cells;
    int top_bit;
};

BraggMirror bragg_mirror(
    float host_ior, float n1, float n2, float d1_nm, float d2_nm, float cells, float cos_theta_h) {
    BraggMirror mirror;
    mirror.half_path_1 = film_path(host_ior, n1, 0.5 * d1_nm, cos_theta_h);
    mirror.half_path_2 = film_path(host_ior, n2, 0.5 * d2_nm, cos_theta_h);
    vec2 q_squared = vec2(mirror.half_path_1.q2_squared, mirror.half_path_2.q2_squared);
    mirror.is_total = q_squared.x < 0.0;
    float q_host = host_ior * cos_theta_h;
    float q_1 = host_ior == n1 ? q_host : mirror.half_path_1.q2;
    vec2 n_squared = vec2(sq(n1), sq(n2));
    float tangential = sq(host_ior) * ((1.0 - cos_theta_h) * (1.0 + cos_theta_h));
    float rise = (n2 - n1) * (n2 + n1);
    // Vanishes at Brewster's angle.
    float brewster = tangential * (n_squared.x + n_squared.y) / (n_squared.x * n_squared.y) - 1.0;
    mirror.s = BraggPolarisation(q_host, q_1, q_squared, rise, vec2(1.0));
    mirror.p = BraggPolarisation(
        cos_theta_h / host_ior, q_1 / n_squared.x, q_squared / (n_squared * n_squared),
        rise * brewster / (n_squared.x * n_squared.y), n_squared);
    mirror.cells = uint(cells + 0.5);
    mirror.top_bit = 0;
    while ((mirror.cells >> uint(mirror.top_bit + 1)) > 0u) ++mirror.top_bit;
    return mirror;
}

// What a wavelength makes of the mirror: cos ½φ and sin ½φ / q of the two films, and what the squares of the second
// are to be multiplied by.
struct BraggWaves {
    vec2 first;
    vec2 second;
    float scale;
};

// wavenumber : 1/λ in two parts, the first of twelve bits, 1/nm
BraggWaves bragg_waves(BraggMirror mirror, vec2 wavenumber) {
    BraggWaves wave;
    wave.first = film_wave(mirror.half_path_1, wavenumber);
    wave.second = film_wave(mirror.half_path_2, wavenumber);
    // Light that fades in n2 comes divided by cosh ½|φ₂| from an exponent of 1 on. Beyond 5 float32 tells no share
    // that passes from 0.
    wave.scale = 1.0;
    float decay = 2.0 * PI * mirror.half_path_2.thickness_nm * (wavenumber.x + wavenumber.y) * mirror.half_path_2.q2;
    if (mirror.half_path_2.q2_squared < 0.0 && sq(decay) >= 1.0) {
        float growth = exp(min(decay, 5.0));
        wave.scale = 0.25 * sq(growth + 1.0 / growth);
    }
    return wave;
}

// 1 − x and 1 + x of x, the cosine of a cell's own phase, as sums and products that keep the digits of either
vec2 bragg_cell_cosine(BraggPolarisation y, BraggWaves wave) {
    vec2 sc = y.m * vec2(wave.first.y * wave.second.x, wave.first.x * wave.second.y);
    float cc = wave.first.x * wave.second.x;
    float ss = y.m.x * y.m.y * wave.first.y * wave.second.y;
    return 2.0 * wave.scale *
           vec2(dot(y.y_squared, sc) * (sc.x + sc.y), (cc - y.y_squared.x * ss) * (cc - y.y_squared.y * ss));
}

// T_N(x) and U_{N−1}(x) by doubling; gltf_iri/optics/chebyshev_u.py
// Deep in a gap it stops, beyond what U reaches at the edge of 10⁶ cells: all is reflected, and squares overflow.
vec2 chebyshev_pair(BraggMirror mirror, BraggPolarisation y, BraggWaves wave) {
    vec2 cosine = bragg_cell_cosine(y, wave);
    float x = 1.0 - cosine.x;
    float one_minus_x2 = cosine.x * cosine.y;
    vec2 tu = vec2(x, 1.0);
    for (int bit = mirror.top_bit - 1; bit >= 0 && abs(tu.x) + abs(tu.y) < 4e6; --bit) {
        tu = vec2(sq(tu.x) - one_minus_x2 * sq(tu.y), 2.0 * tu.x * tu.y);
        if (((mirror.cells >> uint(bit)) & 1u) == 1u) {
            tu = vec2(x * tu.x - one_minus_x2 * tu.y, x * tu.y + tu.x);
        }
    }
    return tu;
}

// R = N/(N + 4 Y_h Y₁) with N = ((Y_h − Y₁)T − ½(Y_h + Y₁)U ΔY² b₁b₂)² + U²(Y₁(Y_h − Y₁)B − ΔY² b₂ cos φ₁)²,
// b = sin φ / Y, B = b₁ cos φ₂ + b₂ cos φ₁; Fourneau et al. 2024, Eq. 2 and Appendix D, over a common denominator
// tu : T_N and U_{N−1}
float bragg_reflectance(BraggMirror mirror, BraggPolarisation y, BraggWaves wave, vec2 tu) {
    float size = max(1.0, max(abs(tu.x), abs(tu.y)));  // keeps the squares below float32's greatest number
    tu /= size;

    float b_1 = 2.0 * y.m.x * wave.first.x * wave.first.y;
    float b_2 = 2.0 * y.m.y * wave.second.x * wave.second.y * wave.scale;
    float cos_1 = 1.0 - 2.0 * mirror.half_path_1.q2_squared * sq(wave.first.y);
    float cos_2 = wave.scale * (sq(wave.second.x) - mirror.half_path_2.q2_squared * sq(wave.second.y));
    float out_of_host = y.y_host - y.y_1;
    float swing = y.step_up * b_2;
    float real = out_of_host * tu.x - 0.5 * (y.y_host + y.y_1) * swing * b_1 * tu.y;
    float imaginary = tu.y * (y.y_1 * out_of_host * (b_1 * cos_2 + b_2 * cos_1) - swing * cos_1);
    float reflected = sq(real) + sq(imaginary);
    float total = reflected + (2.0 * y.y_host / size) * (2.0 * y.y_1 / size);
    // Both vanish only where all media match at grazing: then nothing reflects.
    return total > 0.0 ? reflected / total : 0.0;
}

// wavenumber : 1/λ in two parts, the first of twelve bits, 1/nm
float bragg_reflectance(BraggMirror mirror, vec2 wavenumber) {
    if (mirror.is_total) return 1.0;
    BraggWaves wave = bragg_waves(mirror, wavenumber);
    return 0.5 * (bragg_reflectance(mirror, mirror.s, wave, chebyshev_pair(mirror, mirror.s, wave)) +
                  bragg_reflectance(mirror, mirror.p, wave, chebyshev_pair(mirror, mirror.p, wave)));
}

float bragg_reflectance(
    float host_ior, float n1, float n2, float d1_nm, float d2_nm, float cells, float wavelength_nm,
    float cos_theta_h) {
    BraggMirror mirror = bragg_mirror(host_ior, n1, n2, d1_nm, d2_nm, cells, cos_theta_h);
    return bragg_reflectance(mirror, wavenumber_parts(wavelength_nm));
}
