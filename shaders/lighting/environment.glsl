// The environment prefiltered: the sharp map, layers for roughness ⅛ … 1, irradiance, and the DFG table.
// Made by shaders/pass/{prefilter,prefilter_rough,dfg}.frag.

#include "common/math.glsl"
#include "lighting/dfg.glsl"
#include "lighting/equirect.glsl"

uniform sampler2D u_environment;
uniform sampler2D u_environment_smooth;  // layers of low roughness
uniform sampler2D u_environment_rough;   // layers of high roughness, then irradiance
uniform sampler2D u_dfg;
uniform int u_smooth_layer_count;
uniform int u_layer_count;

vec3 environment_layer(vec2 uv, int layer) {
    if (layer < u_smooth_layer_count) {
        return sample_stack(u_environment_smooth, u_smooth_layer_count, layer, uv).rgb;
    }
    int rough_count = u_layer_count - u_smooth_layer_count + 1;
    return sample_stack(u_environment_rough, rough_count, layer - u_smooth_layer_count, uv).rgb;
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
    return environment_layer(equirect_from_direction(normal), u_layer_count);
}
