// Light of the environment and from behind on the surface, below any coat: the split sum.
// Karis 2013, "Real Shading in Unreal Engine 4".

#include "lighting/view.glsl"
#include "pass/surface_outputs.glsl"
#if defined(HAS_IMAGE_LIGHT) || defined(HAS_TRANSMISSION) || defined(HAS_CLEARCOAT)
#include "lighting/dfg.glsl"
#include "lighting/footprint.glsl"
#endif
#if (defined(HAS_IMAGE_LIGHT) || defined(HAS_TRANSMISSION)) && !defined(BRAGG_WHOLE)
#include "lighting/lobes.glsl"
#endif
#ifdef HAS_IMAGE_LIGHT
#include "lighting/environment.glsl"
#endif
#ifdef HAS_ANISOTROPY
#include "lighting/anisotropy.glsl"
#endif
#ifdef HAS_TRANSMISSION
#include "lighting/transmission.glsl"
#endif
#ifdef HAS_SHEEN
#include "lighting/sheen.glsl"
#endif
#if defined(HAS_BRAGG) && (defined(HAS_IMAGE_LIGHT) || defined(HAS_TRANSMISSION))
#include "lighting/bragg_image.glsl"
#endif

ImageLight image_light(Surface s, View w) {
    ImageLight image = no_image_light();
#if defined(HAS_IMAGE_LIGHT) || defined(HAS_TRANSMISSION)
#ifdef HAS_ANISOTROPY
    vec3 dfg = anisotropic_dfg_facets(s, w);
#else
    vec3 dfg = dfg_facets(u_dfg, w.n_dot_v, s.perceptual_roughness);
#endif
    image.dfg = dfg.xy;
#ifdef FILM_FACET_MEAN
    image.facet_cosine = dfg.z;
#endif
#endif
#ifdef HAS_CLEARCOAT
    image.clearcoat_dfg = dfg_terms(u_dfg, w.coat_n_dot_v, s.clearcoat_roughness);
#endif
#ifdef HAS_IMAGE_LIGHT
    vec3 mirrored = reflect(-w.v, w.n);
    float spread_rad = spread_in_pixel(mirrored);
#ifdef HAS_ANISOTROPY
    image.radiance = anisotropic_radiance(s, w, mirrored, image.dfg.x + image.dfg.y, spread_rad) *
                     s.occlusion;
#else
    image.radiance = mirrored_radiance(mirrored, w.n, w.v, s.perceptual_roughness, image.dfg.x + image.dfg.y,
                                       spread_rad) *
                     s.occlusion;
#endif
    image.irradiance = environment_irradiance(w.n) * s.occlusion;
#ifdef HAS_SHEEN
    image.sheen_radiance = environment_sheen_radiance(mirrored, s.sheen_roughness) * s.occlusion;
#endif
#ifdef HAS_BRAGG
    image.layers = light_of_layers(s, w, mirrored, image.radiance, spread_rad);
#endif
#ifdef HAS_CLEARCOAT
    vec3 coat_mirrored = reflect(-w.v, w.coat_n);
    image.clearcoat_radiance =
        mirrored_radiance(coat_mirrored, w.coat_n, w.v, s.clearcoat_roughness,
                          image.clearcoat_dfg.x + image.clearcoat_dfg.y, spread_in_pixel(coat_mirrored)) *
        s.occlusion;
#endif
#endif
#ifdef HAS_TRANSMISSION
    image.transmitted = transmitted_radiance(s, w.n, w.v);
#endif
#ifdef HAS_SHEEN
    image.sheen_albedo = sheen_albedo(u_sheen_albedo, w.n_dot_v, s.sheen_roughness);
#endif
    return image;
}

#if defined(HAS_IMAGE_LIGHT) || defined(HAS_TRANSMISSION)
#ifndef BRAGG_WHOLE
vec3 image_on_base(Surface s, View w, ImageLight image) {
#ifdef FILM_FACET_MEAN
    float facet_cosine = image.facet_cosine;
#else
    float facet_cosine = w.n_dot_v;
#endif
    Lobe lobe = Lobe(w.n_dot_v, facet_cosine, s.perceptual_roughness, image.dfg.x, image.dfg.y);
#ifdef HAS_TRANSMISSION
    return mix_lobes(s, lobe, WhiteLight(image.irradiance, image.radiance, image.transmitted));
#else
    return mix_lobes(s, lobe, WhiteLight(image.irradiance, image.radiance));
#endif
}
#endif

vec3 image_lighting(Surface s, View w, ImageLight image) {
#ifdef BRAGG_WHOLE
    vec3 sent = image_on_layers(s, w, image);
#else
    vec3 sent = image_on_base(s, w, image);
#ifdef HAS_BRAGG
    sent = mix(sent, image_on_layers(s, w, image), s.bragg_factor);
#endif
#endif
#ifdef HAS_SHEEN
    sent *= sheen_weight(s.sheen_color, image.sheen_albedo);
    sent += s.sheen_color * image.sheen_albedo * image.sheen_radiance;
#endif
    return sent;
}
#endif
