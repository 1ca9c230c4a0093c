// What a pixel receives: the colour, and where it is asked for, everything that the pixel was shaded with.
// The targets are those of INPUT_TARGETS and LAYER_INPUT_TARGETS in gltf_iri/rendering/frame.py, in its order.

#include "lighting/view.glsl"
#include "material/surface.glsl"
#if defined(HAS_BRAGG) && defined(HAS_IMAGE_LIGHT)
#include "lighting/layer_light.glsl"
#endif

// Image light as it reached the surface, occlusion included, and what white lobes send of it.
struct ImageLight {
    vec3 radiance;    // prefiltered, along the mirror direction
    vec3 irradiance;  // divided by π
    vec2 dfg;         // (A, B)
#ifdef FILM_FACET_MEAN
    float facet_cosine;  // the mean of V·H over the facets that send it
#endif
#ifdef HAS_TRANSMISSION
    vec3 transmitted;  // from behind; not occluded
#endif
#if defined(HAS_BRAGG) && defined(HAS_IMAGE_LIGHT)
    LayerLight layers;
#endif
#ifdef HAS_SHEEN
    vec3 sheen_radiance;  // prefiltered with the fibres' lobe
    float sheen_albedo;
#endif
#ifdef HAS_CLEARCOAT
    vec3 clearcoat_radiance;  // prefiltered, along the coat's mirror direction
    vec2 clearcoat_dfg;
#endif
};

ImageLight no_image_light() {
    ImageLight image;
    image.radiance = image.irradiance = vec3(0.0);
    image.dfg = vec2(0.0);
#ifdef FILM_FACET_MEAN
    image.facet_cosine = 1.0;
#endif
#ifdef HAS_TRANSMISSION
    image.transmitted = vec3(0.0);
#endif
#if defined(HAS_BRAGG) && defined(HAS_IMAGE_LIGHT)
    image.layers = no_layer_light();
#endif
#ifdef HAS_SHEEN
    image.sheen_radiance = vec3(0.0);
    image.sheen_albedo = 0.0;
#endif
#ifdef HAS_CLEARCOAT
    image.clearcoat_radiance = vec3(0.0);
    image.clearcoat_dfg = vec2(0.0);
#endif
    return image;
}

#if defined(SHADING_INPUTS)
uniform int u_material;  // index into the plans

layout(location = 0) out vec4 out_colour_material;
layout(location = 1) out vec4 out_normal_metallic;
layout(location = 2) out vec4 out_position_roughness;
layout(location = 3) out vec4 out_base_color_film_factor;
layout(location = 4) out vec4 out_dielectric_f0_specular_weight;
layout(location = 5) out vec4 out_radiance_dfg_a;
layout(location = 6) out vec4 out_irradiance_dfg_b;
layout(location = 7) out vec4 out_emission_film_thickness_nm;

void write_surface(Surface s, View w, ImageLight image, vec3 colour) {
    vec2 film = vec2(0.0);
#ifdef HAS_IRIDESCENCE
    film = vec2(s.iridescence_factor, s.iridescence_thickness_nm);
#endif
    out_colour_material = vec4(colour, float(u_material + 1));
    out_normal_metallic = vec4(w.n, s.metallic);
    out_position_roughness = vec4(v_position, s.perceptual_roughness);
    out_base_color_film_factor = vec4(s.base_color, film.x);
    out_dielectric_f0_specular_weight = vec4(s.dielectric_f0, s.specular_weight);
    out_radiance_dfg_a = vec4(image.radiance, image.dfg.x);
    out_irradiance_dfg_b = vec4(image.irradiance, image.dfg.y);
    out_emission_film_thickness_nm = vec4(s.emission, film.y);
}
#elif defined(LAYER_INPUTS)
layout(location = 0) out vec4 out_transmitted_radiance_transmission;
layout(location = 1) out vec4 out_clearcoat_normal_clearcoat;
layout(location = 2) out vec4 out_clearcoat_radiance_clearcoat_roughness;
layout(location = 3) out vec4 out_sheen_color_sheen_roughness;
layout(location = 4) out vec4 out_sheen_radiance_iridescence_thickness_std_nm;
layout(location = 5) out vec4 out_anisotropy_tangent_anisotropy_strength;
layout(location = 6) out vec4 out_layer_albedos_facet_cosine;

void write_surface(Surface s, View w, ImageLight image, vec3 colour) {
    out_transmitted_radiance_transmission = vec4(0.0);
    out_clearcoat_normal_clearcoat = out_clearcoat_radiance_clearcoat_roughness = vec4(0.0);
    out_sheen_color_sheen_roughness = vec4(0.0);
    out_sheen_radiance_iridescence_thickness_std_nm = vec4(0.0);
    out_anisotropy_tangent_anisotropy_strength = vec4(0.0);
    out_layer_albedos_facet_cosine = vec4(0.0);
#ifdef HAS_TRANSMISSION
    out_transmitted_radiance_transmission = vec4(image.transmitted, s.transmission);
#endif
#ifdef HAS_CLEARCOAT
    out_clearcoat_normal_clearcoat = vec4(w.coat_n, s.clearcoat);
    out_clearcoat_radiance_clearcoat_roughness = vec4(image.clearcoat_radiance, s.clearcoat_roughness);
    out_layer_albedos_facet_cosine.xy = image.clearcoat_dfg;
#endif
#ifdef HAS_SHEEN
    out_sheen_color_sheen_roughness = vec4(s.sheen_color, s.sheen_roughness);
    out_sheen_radiance_iridescence_thickness_std_nm.rgb = image.sheen_radiance;
    out_layer_albedos_facet_cosine.z = image.sheen_albedo;
#endif
#ifdef FILM_FACET_MEAN
    out_layer_albedos_facet_cosine.a = image.facet_cosine;
#endif
#ifdef HAS_IRIDESCENCE_THICKNESS_SPREAD
    out_sheen_radiance_iridescence_thickness_std_nm.a = s.iridescence_thickness_std_nm;
#endif
#ifdef HAS_ANISOTROPY
    out_anisotropy_tangent_anisotropy_strength = vec4(w.tangent, s.anisotropy_strength);
#endif
}
#elif defined(BRAGG_INPUTS)
layout(location = 0) out vec4 out_bragg_radiance_0_bragg_factor;
layout(location = 1) out vec4 out_bragg_radiance_1_bragg_period_texel;
layout(location = 2) out vec4 out_bragg_radiance_2;
layout(location = 3) out vec4 out_bragg_radiance_3;
layout(location = 4) out vec4 out_bragg_metal_radiance;
layout(location = 5) out vec4 out_bragg_coating_radiance;

void write_surface(Surface s, View w, ImageLight image, vec3 colour) {
    out_bragg_radiance_0_bragg_factor = out_bragg_radiance_1_bragg_period_texel = vec4(0.0);
    out_bragg_radiance_2 = out_bragg_radiance_3 = vec4(0.0);
    out_bragg_metal_radiance = out_bragg_coating_radiance = vec4(0.0);
#ifdef HAS_BRAGG
    out_bragg_radiance_0_bragg_factor.a = s.bragg_factor;
    out_bragg_radiance_1_bragg_period_texel.a = s.bragg_period_texel;
#ifdef HAS_IMAGE_LIGHT
    vec3 radiance[4] = vec3[4](vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    for (int i = 0; i < BRAGG_LAYERS; ++i) {
        radiance[i] = image.layers.radiance[i];
    }
    out_bragg_radiance_0_bragg_factor.rgb = radiance[0];
    out_bragg_radiance_1_bragg_period_texel.rgb = radiance[1];
    out_bragg_radiance_2.rgb = radiance[2];
    out_bragg_radiance_3.rgb = radiance[3];
    out_bragg_metal_radiance.rgb = image.layers.metal_radiance;
    out_bragg_coating_radiance.rgb = image.layers.coating_radiance;
#endif
#endif
}
#else
layout(location = 0) out vec4 out_colour;  // premultiplied; alpha is coverage

void write_surface(Surface s, View w, ImageLight image, vec3 colour) {
#ifdef HAS_ALPHA_BLEND
    out_colour = vec4(colour * s.alpha, s.alpha);
#else
    out_colour = vec4(colour, 1.0);
#endif
}
#endif
