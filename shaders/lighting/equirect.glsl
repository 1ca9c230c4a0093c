// Directions on an equirectangular map: row 0 at +Y, the middle column at +X, +Z to its right.

#include "common/math.glsl"

// (u, v) = (½ + atan2(z, x) / 2π, acos(y) / π); acos as atan2, for near the poles acos keeps half of the digits.
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
