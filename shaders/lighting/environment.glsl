// The environment prefiltered: sharp map, layers for roughness ⅛ … 1, irradiance, DFG table.
// Made by shaders/pass/{prefilter,irradiance,dfg}.frag.

#include "common/math.glsl"
#include "lighting/dfg.glsl"
#include "lighting/equirect.glsl"

uniform sampler2D u_environment;
uniform sampler2D u_environment_layers;  // layers of growing roughness, one below the other
uniform sampler2D u_environment_irradiance;
uniform sampler2D u_dfg;
uniform int u_layer_count;

vec3 environment_layer(vec2 uv, int layer) {
    float height = float(textureSize(u_environment_layers, 0).y / u_layer_count);
    // Half a texel from the edge, the filter does not reach into the next layer.
    float row = clamp(uv.y * height, 0.5, height - 0.5) + float(layer) * height;
    return textureLod(u_environment_layers, vec2(uv.x, row / (height * float(u_layer_count))), 0.0).rgb;
}

// Radiance from `direction` as a lobe of the given roughness sees it. `spread_rad`: angle between the directions of
// neighbouring pixels, below which the sharp map must not be sampled.
vec3 environment_radiance(vec3 direction, float perceptual_roughness, float spread_rad) {
    vec2 uv = equirect_from_direction(direction);
    float layer = perceptual_roughness * float(u_layer_count) - 1.0;
    vec3 rougher = environment_layer(uv, max(int(ceil(layer)), 0));
    if (layer >= 0.0) {
        return mix(environment_layer(uv, int(layer)), rougher, fract(layer));
    }
    float level = log2(max(spread_rad * float(textureSize(u_environment, 0).y) / PI, 1.0));
    return mix(textureLod(u_environment, uv, level).rgb, rougher, layer + 1.0);
}

// E/π: a white environment gives 1.
vec3 environment_irradiance(vec3 normal) {
    return textureLod(u_environment_irradiance, equirect_from_direction(normal), 0.0).rgb;
}
