// Light of the environment on Bragg layers, and from behind: the split sum, a lobe for each layer. Each layer sends
// prefiltered radiance of its own roughness, times what it sends of a white sky.

#include "lighting/layer_colours.glsl"
#include "optics/layer_stack.glsl"
#if defined(BRAGG_BASE) && defined(HAS_DIELECTRIC)
#include "lighting/bragg_through.glsl"
#endif
#ifdef HAS_IMAGE_LIGHT
#include "lighting/environment.glsl"
#include "lighting/layer_light.glsl"

// Seen through the coating facets seem to lean more: their slopes are n cosθ'/cosθ times as steep, with θ' inside.
float seen_roughness(float alpha, View w) {
#ifdef BRAGG_COATING
    alpha *= u_bragg_host_ior * cosine_at_layers(w) / w.n_dot_v;
#endif
    return sqrt(min(alpha, 1.0));
}

vec3 radiance_of_facets(float alpha, View w, vec3 mirrored, float spread_rad) {
    float roughness = seen_roughness(alpha, w);
    vec2 dfg = dfg_terms(u_dfg, w.n_dot_v, roughness);
    return mirrored_radiance(mirrored, w.n, w.v, roughness, dfg.x + dfg.y, spread_rad);
}

LayerLight light_of_layers(Surface s, View w, vec3 mirrored, vec3 base_radiance, float spread_rad) {
    LayerLight light = no_layer_light();
    for (int i = 0; i < BRAGG_LAYERS; ++i) {
        light.radiance[i] = radiance_of_facets(u_bragg_alpha[i], w, mirrored, spread_rad) * s.occlusion;
    }
#if defined(BRAGG_BASE) && defined(HAS_METAL)
    light.metal_radiance = base_radiance;
#ifdef BRAGG_COATING
    light.metal_radiance = radiance_of_facets(s.alpha_roughness, w, mirrored, spread_rad) * s.occlusion;
#endif
#endif
#ifdef BRAGG_COATING
    light.coating_radiance = radiance_of_facets(0.0, w, mirrored, spread_rad) * s.occlusion;
#endif
    return light;
}
#endif

vec3 image_on_layers(Surface s, View w, ImageLight image) {
    vec3 sent = vec3(0.0);
#if defined(BRAGG_BASE) && defined(HAS_TRANSMISSION)
    sent += passed_from_behind(s, w) * image.transmitted;
#endif
#ifdef HAS_IMAGE_LIGHT
    for (int i = 0; i < BRAGG_LAYERS; ++i) {
        sent += layer_albedo(s, w, i) * image.layers.radiance[i];
    }
#if defined(BRAGG_BASE) && defined(HAS_METAL)
    sent += s.metallic * metal_albedo(s, w) * image.layers.metal_radiance;
#endif
#if defined(BRAGG_BASE) && defined(HAS_DIELECTRIC)
    sent += scattered_by_base(s) * scattered_albedo(s, w) * image.irradiance;
#endif
#endif
#ifdef BRAGG_COATING
    float passed = coating_transmittance(u_bragg_host_ior, w.n_dot_v);
    sent *= passed;
#ifdef HAS_IMAGE_LIGHT
    sent += (1.0 - passed) * image.layers.coating_radiance;
#endif
#endif
    return sent;
}
