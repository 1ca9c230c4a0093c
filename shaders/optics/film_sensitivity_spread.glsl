// The eye's sensitivities in Fourier space, averaged over a Gaussian spread of path differences.
// gltf_iri/colour/damped_sensitivity.py has the equations and fills the table, gltf_iri/rendering/spread_table.py lays
// it out: for each of some spreads what film_sensitivity.glsl has for none, in coarser texels.

#include "common/math.glsl"
#include "generated/film_constants.glsl"

uniform highp usampler2D film_sensitivity_spread;

// A channel's word has its slope from texel to texel in the last bits; the value, rounded for it, is the whole word.
vec3 spread_line(uvec3 words, float t) {
    vec3 slope = vec3(ivec3(words << SPREAD_SLOPE_SHIFT));
    return SPREAD_UNIT * vec3(ivec3(words)) + (SPREAD_SLOPE_UNIT * t) * slope;
}

// Re Ŝ(D, s) of the three channels, and a bound of it for all greater D and s, over half of the tolerance.
// Ŝ(D, s) = (1 − t) exp(−κ(u − u₀)) Ŝ(D, s₀) + t exp(κ(u₁ − u)) Ŝ(D, s₁), u = s², t = (u − u₀)/(u₁ − u₀)
vec4 sensitivity_spread(float opd_nm, float opd_std_nm) {
    float far = SPREAD_FAR_PER_NM * opd_nm + (1.0 - SPREAD_FAR_PER_NM) * SPREAD_FINE_END_NM;
    float at = min(min(opd_nm, far), SPREAD_LAST);
    float nearest = floor(at + 0.5);
    int i = int(nearest);

    float u = min(sq(opd_std_nm), SPREAD_SQUARED_MAX);
    float rows_per_part = float(SPREADS - 1) / SPREAD_PART_MAX;
    float row = min(floor(rows_per_part * u / (u + SPREAD_SQUARED_SCALE)), float(SPREADS - 2));
    vec2 part = vec2(row, row + 1.0) / rows_per_part;
    vec2 around = SPREAD_SQUARED_SCALE * part / (1.0 - part);
    float t = (u - around.x) / (around.y - around.x);
    vec3 narrower = (1.0 - t) * exp(DAMPING_PER_NM2 * (around.x - u));
    vec3 wider = t * exp(DAMPING_PER_NM2 * (around.y - u));

    ivec2 texel = ivec2(i & (SPREAD_ROW - 1), (i >> SPREAD_ROW_BITS) + int(row) * SPREAD_ROWS);
    uvec4 first = texelFetch(film_sensitivity_spread, texel, 0);
    uvec4 second = texelFetch(film_sensitivity_spread, texel + ivec2(0, SPREAD_ROWS), 0);
    vec3 real_part = narrower * spread_line(first.rgb, at - nearest) + wider * spread_line(second.rgb, at - nearest);
    return vec4(real_part, mix(uintBitsToFloat(first.a), uintBitsToFloat(second.a), t));
}
