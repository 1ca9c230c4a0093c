// The film's Fourier series on bases of complex index n + ik: metals by their own data.
// Twin: gltf_iri/evaluation/fourier.py.

#include "common/complex.glsl"
#include "optics/fourier.glsl"

struct ComplexAdmittances {
    float y1;
    float y2;
    vec2 y3;
    float scale;
};

struct ComplexFilmSeries {
    float entering;  // G/2
    vec2 ratio;      // z
    float tail;      // H/G
};

// R = 1 − G(1 + 2Σ Re zᵐŜ), z = −(Y₁ − Y₂)(Y₂ − Y₃)/((Y₁ + Y₂)(Y₂ + Y₃)), G = 4Y₁Y₂Re Y₃/(Y₁|Y₂ + Y₃|² + (Y₁ − Y₂)²Re Y₃)
// Belcour & Barla 2017, Eq. 5-6, in admittances
ComplexFilmSeries film_series(ComplexAdmittances y) {
    float first = y.y1 + y.y2;
    float contrast = y.y1 - y.y2;
    vec2 second = vec2(y.y2 + y.y3.x, y.y3.y);
    float second_squared = dot(second, second);
    float inverse = 1.0 / (y.y1 * second_squared + contrast * contrast * y.y3.x);
    vec2 ratio = (-contrast / first) * complex_quotient(vec2(y.y2 - y.y3.x, -y.y3.y), second);
    float tail = (1.0 + length(ratio)) * (0.25 / y.y2 * first * first) * (second_squared * inverse);
    return ComplexFilmSeries(2.0 * y.y1 * y.y2 * y.y3.x * inverse, ratio, tail);
}

// What enters the base at one wavelength: 4 Y₁ Re Y₃ over |(Y₁ + Y₃) cos β − i(Y₂² + Y₁Y₃) sin β/Y₂|².
// Belcour & Barla 2017, Eq. 2-3; Airy summation
float entering_airy(ComplexAdmittances y, float y2_squared, vec2 wave) {
    float along = y.scale * wave.y;
    vec2 den = vec2((y.y1 + y.y3.x) * wave.x + along * y.y1 * y.y3.y,
                    y.y3.y * wave.x - along * (y2_squared + y.y1 * y.y3.x));
    return 4.0 * y.y1 * y.y3.x / dot(den, den);
}

// R_j for the three channels' weights, as film_colour_fourier; the base's index is one number.
vec3 film_colour_fourier(
    float outside_ior, float film_ior, Base base, float thickness_nm, float cos_theta_1) {
    float cosine = max(cos_theta_1, GRAZING);
    float q1 = outside_ior * cosine;
    float q2_squared = normal_index_squared(film_ior, outside_ior, cosine);
    float q2 = sqrt(max(q2_squared, 0.0));
    vec2 n3 = vec2(base.n, base.k);
    vec2 q3 = complex_root(base_normal_index_squared(base, outside_ior, cosine));
    float one = outside_ior * outside_ior, two = film_ior * film_ior;
    vec2 y3 = complex_quotient(complex_quotient(q3, n3), n3) * (one * two);
    ComplexAdmittances y_s = ComplexAdmittances(q1, q2, q3, 1.0);
    ComplexAdmittances y_p = ComplexAdmittances(q1 * two, q2 * one, y3, 1.0 / one);

    float opd_nm = 2.0 * thickness_nm * q2;
    vec3 entering = vec3(0.0);
    if (base.is_mirror) {
        return vec3(1.0);
    }
    if (opd_nm <= FOURIER_THIN_OPD_NM) {
        for (int i = 0; i < SPECTRAL_SMOOTH_COUNT; ++i) {
            vec4 node = smooth_node(i);
            vec2 wave = smooth_wave(q2_squared, 2.0 * PI * thickness_nm * node.a);
            entering += 0.5 * node.rgb *
                        (entering_airy(y_s, q2_squared, wave) + entering_airy(y_p, q2_squared * one * one, wave));
        }
        return 1.0 - entering;
    }
    ComplexFilmSeries s = film_series(y_s), p = film_series(y_p);
    entering = vec3(s.entering + p.entering);
    vec2 power_s = 2.0 * s.entering * s.ratio, power_p = 2.0 * p.entering * p.ratio;
    for (int m = 1; m <= FOURIER_ORDERS; ++m) {
        SensitivityPlace place = sensitivity_place(float(m) * opd_nm);
        vec4 real_part = sensitivity_real(place);
        float bound = (length(power_s) * s.tail + length(power_p) * p.tail) * real_part.a;
        vec2 weight = (power_s + power_p) * clamp(bound - 1.0, 0.0, 1.0);
        entering += weight.x * real_part.rgb - weight.y * sensitivity_imaginary(place);
        power_s = complex_product(power_s, s.ratio);
        power_p = complex_product(power_p, p.ratio);
        if (!(bound > 1.0)) {
            break;
        }
    }
    return 1.0 - entering;
}

// base_n + i base_k : the base's index, channel by channel.
vec3 iridescent_fresnel_fourier(
    float outside_ior, float film_ior, vec3 base_n, vec3 base_k, float thickness_nm, float cos_theta_1) {
    vec3 colour;
    for (int c = 0; c < 3; ++c) {
        Base base = base_of_index(base_n[c], base_k[c]);
        colour[c] = film_colour_fourier(outside_ior, film_ior, base, thickness_nm, cos_theta_1)[c];
    }
    return colour;
}
