// The eye's sensitivities in Fourier space, read linearly between texels a small part of a fringe apart: two fetches
// where the cubics of gltf_iri/colour/sensitivity_table.py, which fill the table, would take four.
// gltf_iri/rendering/optics_tables.py lays it out.

#include "generated/film_constants.glsl"

uniform highp sampler2D film_sensitivity;

// Where a path difference lies: a texel, and how far towards the next in [0, 1]. Beyond the table all is 0.
struct SensitivityPlace {
    ivec2 texel;
    float t;
};

SensitivityPlace sensitivity_place(float opd_nm) {
    // Finer as far as SENSITIVITY_FINE_END_NM, where the sensitivities are great; then in whole nanometres.
    float at = min(SENSITIVITY_FINE_PER_NM * opd_nm,
                   opd_nm + (SENSITIVITY_FINE_PER_NM - 1.0) * SENSITIVITY_FINE_END_NM);
    float first = min(floor(at), SENSITIVITY_LAST);
    int i = int(first);
    ivec2 texel = ivec2(i & ((1 << SENSITIVITY_ROW_BITS) - 1), i >> SENSITIVITY_ROW_BITS);
    return SensitivityPlace(texel, min(at - first, 1.0));
}

// Re Ŝ of the three channels, and a bound of |Ŝ| at and beyond the place, over half of the tolerance.
vec4 sensitivity_real(SensitivityPlace place) {
    vec4 here = texelFetch(film_sensitivity, place.texel, 0);
    vec4 next = texelFetch(film_sensitivity, place.texel + ivec2(1, 0), 0);
    return here + place.t * (next - here);
}

// Im Ŝ of the three channels.
vec3 sensitivity_imaginary(SensitivityPlace place) {
    return sensitivity_real(SensitivityPlace(place.texel + ivec2(0, SENSITIVITY_ROWS), place.t)).rgb;
}
