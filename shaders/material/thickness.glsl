// How thick a film is within a pixel: mean and standard deviation, from mip levels of first and second moments.
// Belcour & Barla 2017, section 5, Multi-scale Rendering: a Gaussian of these stands for the thicknesses.
// gltf_iri/rendering/moments.py makes the levels.

#include "generated/material.glsl"
#include "lighting/footprint.glsl"

// Of E[t²] − E[t]² in float32, t up to 1; 8-bit texels that differ do so by more.
const float MOMENTS_ROUNDING = 2.5e-7;

const int LONGEST_FOOTPRINT = 4;

// Where a pixel's parallelogram is longer than wide, texels of its width stand in a row along it.
// A row of `count` places `step_uv` apart, each as wide as `width` texels of the base level.
struct Footprint {
    vec2 step_uv;
    int count;
    float width;
};

Footprint texture_footprint(vec2 uv, vec2 size) {
    vec2 across_uv = u_footprint * dFdx(uv), down_uv = u_footprint * dFdy(uv);
    vec2 across = across_uv * size, down = down_uv * size;
    float wide = length(across), high = length(down);
    float major = max(wide, high);
    // A footprint without a side has no area, and is as wide as it is long: not at all.
    float minor = major > 0.0 ? abs(across.x * down.y - across.y * down.x) / major : 0.0;
    float count = clamp(ceil(major / max(minor, 1e-6) - 0.5), 1.0, float(LONGEST_FOOTPRINT));
    return Footprint((wide > high ? across_uv : down_uv) / count, int(count), max(minor, major / count));
}

// (E[t], standard deviation of t) of a thickness texture over the pixel; t in [0, 1].
//
// Filtered linearly, texels of 2^l spread as (2^l)²/4 − 1/12 of a slope's square, over all phases: their own
// discrete width, (4^l − 1)/12, and 4^l/6 of the filter. A pixel of w texels spreads as w²/12, so
// 4^l = (w² + 1)/3. From w² = 2 down the base level alone would spread by 1/6, however small the pixel.
vec2 thickness_in_pixel(vec2 uv) {
    Footprint pixel = texture_footprint(uv, vec2(textureSize(u_iridescence_thickness_texture, 0)));
    float square = pixel.width * pixel.width;
    float level = max(0.5 * log2((square + 1.0) / 3.0), 0.0);
    vec2 first = uv - (0.5 * float(pixel.count - 1)) * pixel.step_uv;
    vec2 moments = vec2(0.0);
    for (int i = 0; i < pixel.count; ++i) {
        moments += textureLod(u_iridescence_thickness_texture, first + float(i) * pixel.step_uv, level).gr;
    }
    moments /= float(pixel.count);
    float variance = max(moments.y - moments.x * moments.x - MOMENTS_ROUNDING, 0.0);
    return vec2(moments.x, sqrt(variance * min(0.5 * square, 1.0)));
}
