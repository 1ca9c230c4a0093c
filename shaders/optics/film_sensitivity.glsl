// The eye's sensitivities in Fourier space, each texel a line through the path differences that are nearest to it: one
// fetch where the cubics of gltf_iri/colour/sensitivity_table.py, which fill the table, would take four.
// gltf_iri/rendering/optics_tables.py lays it out.

#include "generated/film_constants.glsl"

uniform highp usampler2D film_sensitivity;

// Where a path difference lies: the nearest texel, and how far from it in [−½, ½]. Beyond the table all is 0.
struct SensitivityPlace {
    ivec2 texel;
    float t;
};

SensitivityPlace sensitivity_place(float opd_nm) {
    // Finer as far as SENSITIVITY_FINE_END_NM, where the sensitivities are great; then in whole nanometres.
    float at = min(SENSITIVITY_FINE_PER_NM * opd_nm,
                   opd_nm + (SENSITIVITY_FINE_PER_NM - 1.0) * SENSITIVITY_FINE_END_NM);
    at = min(at, SENSITIVITY_LAST);
    float nearest = floor(at + 0.5);
    int i = int(nearest);
    return SensitivityPlace(ivec2(i & (SENSITIVITY_ROW - 1), i >> SENSITIVITY_ROW_BITS), at - nearest);
}

// A channel's word has its slope from texel to texel in the last bits; the value, rounded for it, is the whole word.
vec3 sensitivity_line(uvec3 words, float t) {
    vec3 slope = vec3(ivec3(words << SENSITIVITY_SLOPE_SHIFT));
    return SENSITIVITY_UNIT * vec3(ivec3(words)) + (SENSITIVITY_SLOPE_UNIT * t) * slope;
}

// Re Ŝ of the three channels, and a bound of |Ŝ| at and beyond the place, over half of the tolerance.
vec4 sensitivity_real(SensitivityPlace place) {
    uvec4 words = texelFetch(film_sensitivity, place.texel, 0);
    return vec4(sensitivity_line(words.rgb, place.t), uintBitsToFloat(words.a));
}

// Im Ŝ of the three channels.
vec3 sensitivity_imaginary(SensitivityPlace place) {
    uvec4 words = texelFetch(film_sensitivity, place.texel + ivec2(0, SENSITIVITY_ROWS), 0);
    return sensitivity_line(words.rgb, place.t);
}
