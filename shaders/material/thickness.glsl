// How thick a film is within a pixel: mean and standard deviation, from mip levels of first and second moments.
// Belcour & Barla 2017, section 5, Multi-scale Rendering: a Gaussian of these stands for the thicknesses.
// gltf_iri/asset/moments.py makes the levels.

#include "generated/material.glsl"
#include "lighting/footprint.glsl"

// ROUNDING of gltf_iri/asset/moments.py.
const float MOMENTS_ROUNDING = 2.5e-7;

// Places that a pixel is read at, at most: filtering takes in twice the width of a texel, so that few large texels
// would take in the pixels beside it, and along a pixel that is longer than wide there is room for more.
const float PLACES_ALONG = 8.0;
const float PLACES_ACROSS = 2.0;

// (E[t], standard deviation of t) of the thickness texture over the pixel's parallelogram; t in [0, 1].
//
// Filtered linearly, texels of 2^l spread as (2^l)²/4 − 1/12 of a slope's square, over all phases: (4^l − 1)/12 by
// themselves and 4^l/6 by the filter. A width of w texels spreads as w²/12, so 4^l = (w² + 1)/3. Below w² = 2 the
// base level spreads as 1/6 by the filter alone, however small the pixel, and is scaled by w²/2.
vec2 thickness_in_pixel(vec2 uv) {
    vec2 size = vec2(textureSize(u_iridescence_thickness_texture, 0));
    vec2 right_uv = u_footprint * dFdx(uv), up_uv = u_footprint * dFdy(uv);
    vec2 right = right_uv * size, up = up_uv * size;
    bool is_wide = dot(right, right) > dot(up, up);
    float long_texels = sqrt(max(dot(right, right), dot(up, up)));
    // A pixel without length has no width either.
    float wide_texels = long_texels > 0.0 ? abs(right.x * up.y - right.y * up.x) / long_texels : 0.0;

    float wanted = max(max(wide_texels / PLACES_ACROSS, long_texels / PLACES_ALONG), sqrt(2.0));
    vec2 places = max(floor(vec2(long_texels, wide_texels) / wanted + 0.5), 1.0);
    float width = max(long_texels / places.x, wide_texels / places.y);
    float level = max(0.5 * log2((width * width + 1.0) / 3.0), 0.0);

    vec2 along = (is_wide ? right_uv : up_uv) / places.x, across = (is_wide ? up_uv : right_uv) / places.y;
    vec2 first = uv - 0.5 * ((places.x - 1.0) * along + (places.y - 1.0) * across);
    vec2 moments = vec2(0.0);
    for (float i = 0.0; i < places.x; ++i) {
        for (float j = 0.0; j < places.y; ++j) {
            moments += textureLod(u_iridescence_thickness_texture, first + i * along + j * across, level).gr;
        }
    }
    moments /= places.x * places.y;
    float variance = max(moments.y - moments.x * moments.x - MOMENTS_ROUNDING, 0.0);
    return vec2(moments.x, sqrt(variance * min(0.5 * width * width, 1.0)));
}
