// Directions on an equirectangular map: first row towards +Y, middle column at +X, +Z to its right.

#include "common/math.glsl"

// (u, v) = (½ + atan2(z, x) / 2π, acos(y) / π); acos as atan2: near the poles acos keeps half of the digits.
vec2 equirect_from_direction(vec3 direction) {
    float horizon = length(direction.xz);
    // atan(0, 0) is undefined; at the poles every column is the same place.
    float azimuth = horizon > 0.0 ? atan(direction.z, direction.x) : 0.0;
    return vec2(0.5 + azimuth / (2.0 * PI), atan(horizon, direction.y) / PI);
}

vec3 direction_from_equirect(vec2 uv) {
    float azimuth = (uv.x - 0.5) * 2.0 * PI;
    float polar = uv.y * PI;
    return vec3(sin(polar) * cos(azimuth), cos(polar), sin(polar) * sin(azimuth));
}

// Maps made here have the poles themselves in their first and last row, so that filtering is continuous there, and
// may stand one below the other: `size` is that of one map, `index` its place in the stack.
vec3 direction_of_texel(vec2 pixel, vec2 size) {
    return direction_from_equirect(vec2(pixel.x / size.x, (mod(pixel.y, size.y) - 0.5) / (size.y - 1.0)));
}

vec4 sample_stack(sampler2D stack, int count, int index, int level, vec2 uv) {
    float height = float(textureSize(stack, level).y / count);
    float row = uv.y * (height - 1.0) + 0.5 + float(index) * height;
    return textureLod(stack, vec2(uv.x, row / (height * float(count))), float(level));
}
