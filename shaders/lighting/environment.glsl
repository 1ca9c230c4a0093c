// The environment: the sharp map, the same without its lamps, that one prefiltered, and the lamps by formula.
// Made by gltf_iri/rendering/environment_light.py with shaders/pass/prefilter*.frag.

#include "common/math.glsl"
#include "generated/constants.glsl"
#include "lighting/dfg.glsl"
#include "lighting/equirect.glsl"
#include "lighting/lamps.glsl"
#ifdef HAS_SHEEN
#include "generated/layer_constants.glsl"
#endif

uniform sampler2D u_environment;
uniform sampler2D u_environment_rest;
uniform sampler2D u_environment_layers;
#ifdef HAS_SHEEN
uniform sampler2D u_environment_sheen;
#endif

// A layer of roughness; the one behind the last is irradiance.
vec3 environment_layer(vec2 uv, int layer) {
    int level = layer / LAYERS_PER_LEVEL;
    return sample_stack(u_environment_layers, LAYERS_PER_LEVEL, layer - level * LAYERS_PER_LEVEL, level, uv).rgb;
}

// Radiance from `direction` as a lobe of the given roughness sees it. `spread_rad`: angle between the directions of
// neighbouring pixels: the sharp map and its lamps are averaged over as much. Layers are not: their lobes have tails,
// and a wider one would carry bright light to where no direction in the pixel meets it.
vec3 environment_radiance(vec3 direction, float perceptual_roughness, float spread_rad) {
    vec2 uv = equirect_from_direction(direction);
    float alpha = max(sq(perceptual_roughness), ALPHA_MIN);
    float texel_rad = PI / float(textureSize(u_environment, 0).y);
    float level = log2(max(spread_rad / texel_rad, 1.0));

    vec3 rest;
    float layer = 2.0 * log2(max(perceptual_roughness / LAYER_ROUGHNESS_MIN, 1.0));
    if (perceptual_roughness >= LAYER_ROUGHNESS_MIN) {
        rest = mix(environment_layer(uv, int(layer)), environment_layer(uv, int(ceil(layer))), fract(layer));
    } else {
        rest = mix(textureLod(u_environment_rest, uv, level).rgb, environment_layer(uv, 0),
                   perceptual_roughness / LAYER_ROUGHNESS_MIN);
    }
    // A lobe narrower than a texel shows the lamp as the map has it, unless the pixel itself sees more than a texel.
    float by_formula = clamp(max((alpha - ALPHA_MIN) / (0.25 * texel_rad), spread_rad / texel_rad - 1.0), 0.0, 1.0);
    vec3 lamps = vec3(0.0);
    if (by_formula < 1.0) {
        lamps = textureLod(u_environment, uv, level).rgb - textureLod(u_environment_rest, uv, level).rgb;
    }
    if (by_formula > 0.0) {
        lamps = mix(lamps, lamp_radiance(direction, alpha, spread_rad), by_formula);
    }
    return rest + lamps;
}

// E/π: a white environment gives 1.
vec3 environment_irradiance(vec3 normal) {
    return environment_layer(equirect_from_direction(normal), ROUGHNESS_LAYERS) + lamp_irradiance(normal);
}

#ifdef HAS_SHEEN
// Radiance as fibres collect it about the mirror direction.
vec3 environment_sheen_radiance(vec3 direction, float sheen_roughness) {
    vec2 uv = equirect_from_direction(direction);
    float layer = sheen_roughness * float(SHEEN_LAYERS - 1);
    return mix(sample_stack(u_environment_sheen, SHEEN_LAYERS, int(layer), 0, uv).rgb,
               sample_stack(u_environment_sheen, SHEEN_LAYERS, int(ceil(layer)), 0, uv).rgb, fract(layer));
}
#endif
