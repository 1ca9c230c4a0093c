// The environment: the sharp map, the same without its lamps, that one prefiltered, and the lamps by formula.
// Made by gltf_iri/rendering/environment_light.py.

#include "common/math.glsl"
#include "generated/constants.glsl"
#include "lighting/dfg.glsl"
#include "lighting/equirect.glsl"
#include "lighting/lamps.glsl"
#include "optics/microfacet.glsl"
#ifdef HAS_SHEEN
#include "generated/layer_constants.glsl"
#endif

uniform sampler2D u_environment;
uniform sampler2D u_environment_rest;
uniform sampler2D u_environment_layers;
#ifdef HAS_SHEEN
uniform sampler2D u_environment_sheen;
#endif

// A layer of roughness; the last is irradiance.
vec3 environment_layer(vec2 uv, int layer) {
    int level = layer / LAYERS_PER_LEVEL;
    return sample_stack(u_environment_layers, LAYERS_PER_LEVEL, layer - level * LAYERS_PER_LEVEL, level, uv).rgb;
}

// Level of the sharp map: filtering reads two texels across, so that each is half of what a pixel spans.
float sharp_level(float spread_rad, float texel_rad) { return log2(max(0.5 * spread_rad / texel_rad, 1.0)); }

float sharp_texel_rad() { return PI / float(textureSize(u_environment, 0).y); }

vec3 rest_radiance(vec2 uv, float perceptual_roughness, float spread_rad) {
    float layer = 2.0 * log2(max(perceptual_roughness / LAYER_ROUGHNESS_MIN, 1.0));
    if (perceptual_roughness >= LAYER_ROUGHNESS_MIN) {
        return mix(environment_layer(uv, int(layer)), environment_layer(uv, int(ceil(layer))), fract(layer));
    }
    float level = sharp_level(spread_rad, sharp_texel_rad());
    return mix(textureLod(u_environment_rest, uv, level).rgb, environment_layer(uv, 0),
               perceptual_roughness / LAYER_ROUGHNESS_MIN);
}

// A lobe narrower than a texel shows lamps as the map has them, unless the pixel itself sees more than a texel.
vec3 lamp_radiance(vec2 uv, LampLobe lobe) {
    float texel_rad = sharp_texel_rad();
    float by_formula = clamp(
        max((widest_alpha(lobe) - ALPHA_MIN) / (0.25 * texel_rad), lobe.spread_rad / texel_rad - 1.0), 0.0, 1.0);
    vec3 lamps = vec3(0.0);
    if (by_formula < 1.0) {
        float level = sharp_level(lobe.spread_rad, texel_rad);
        lamps = textureLod(u_environment, uv, level).rgb - textureLod(u_environment_rest, uv, level).rgb;
    }
    return by_formula > 0.0 ? mix(lamps, lamp_lobe_radiance(lobe), by_formula) : lamps;
}

// Radiance from `direction` as a round lobe of the given roughness sees it. `spread_rad`: angle between the directions
// of neighbouring pixels: the sharp map and its lamps are averaged over as much. Layers are not: their lobes have
// tails, and a wider one would carry bright light to where no direction in the pixel meets it.
vec3 environment_radiance(vec3 direction, float perceptual_roughness, float spread_rad) {
    vec2 uv = equirect_from_direction(direction);
    float alpha = alpha_ggx(perceptual_roughness);
    return rest_radiance(uv, perceptual_roughness, spread_rad) +
           lamp_radiance(uv, LampLobe(direction, alpha, spread_rad, vec3(0.0), vec3(0.0), 0.0, vec4(0.0)));
}

// How far from the normal (0) towards the mirror direction (1) the light lies that a lobe collects: the far side of a
// rough one is masked or below the horizon.
// (1 − α)(√(1 − α) + α)
// Lagarde & de Rousiers 2014, "Moving Frostbite to Physically Based Rendering", the specular lobe's dominant direction.
float mirror_share(float alpha) { return (1.0 - alpha) * (sqrt(1.0 - alpha) + alpha); }

// As environment_radiance, for a surface whose facets mirror `direction` to the viewer: lamps through the facets
// themselves, divided by `albedo`, all that they send of a white sky, which the split sum multiplies by. Layers are
// read nearer the normal the rougher it is.
vec3 mirrored_radiance(vec3 direction, vec3 n, vec3 v, float perceptual_roughness, float albedo, float spread_rad) {
    vec2 uv = equirect_from_direction(direction);
    float alpha = alpha_ggx(perceptual_roughness);
    vec3 middle = normalize(mix(n, direction, mirror_share(alpha)));
    return rest_radiance(equirect_from_direction(middle), perceptual_roughness, spread_rad) +
           lamp_radiance(uv, LampLobe(direction, alpha, spread_rad, n, v, albedo, vec4(0.0)));
}

// E/π: a white environment gives 1.
vec3 environment_irradiance(vec3 normal) {
    return environment_layer(equirect_from_direction(normal), ROUGHNESS_LAYERS - 1) + lamp_irradiance(normal);
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
