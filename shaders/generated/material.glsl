// The material, as gltf_iri/material/ states it. Written by gltf_iri.generate; do not edit.

// Base colour.
uniform vec4 u_base_color_factor;

#ifndef HAS_UNLIT
// 0 dielectric, 1 metal.
uniform float u_metallic_factor;
// Perceptual roughness.
uniform float u_roughness_factor;
#endif

#ifdef HAS_EMISSION
// Emitted light, emissive strength included.
uniform vec3 u_emissive_factor;
#endif

#ifdef HAS_ALPHA_MASK
// Threshold of MASK.
uniform float u_alpha_cutoff;
#endif

#ifdef HAS_SPECULAR
// Weight of the reflection.
uniform float u_specular_factor;
// Tint at normal incidence.
uniform vec3 u_specular_color_factor;
#endif

#ifdef HAS_IRIDESCENCE
// Strength of the film.
uniform float u_iridescence_factor;
// Refractive index of the film.
uniform float u_iridescence_film_ior;
// Film thickness at a texture value of 0.
uniform float u_iridescence_thickness_min_nm;
// Film thickness at 1, or without texture.
uniform float u_iridescence_thickness_max_nm;
#endif

#ifdef HAS_BRAGG
// Strength of the layers.
uniform float u_bragg_factor;
// Refractive index of what the layers lie in.
uniform float u_bragg_host_ior;
#endif

#ifdef HAS_ANISOTROPY
// How far the highlight is drawn out.
uniform float u_anisotropy_strength;
// Counter-clockwise turn of the direction from the tangent.
uniform float u_anisotropy_rotation_rad;
#endif

#ifdef HAS_TRANSMISSION
// Share that is transmitted.
uniform float u_transmission_factor;
#endif

#ifdef HAS_VOLUME
// Depth under the surface, in the mesh's own space.
uniform float u_volume_thickness_factor_m;
// Refractive index of the inside.
uniform float u_volume_ior;
// Absorption: light keeps exp(−absorption · path).
uniform vec3 u_volume_absorption_per_m;
#endif

#ifdef HAS_DISPERSION
// 20 divided by the Abbe number; 0 is none.
uniform float u_dispersion;
#endif

#ifdef HAS_SHEEN
// Colour of the sheen; black is none.
uniform vec3 u_sheen_color_factor;
// Perceptual roughness of the sheen.
uniform float u_sheen_roughness_factor;
#endif

#ifdef HAS_CLEARCOAT
// Strength of the coat.
uniform float u_clearcoat_factor;
// Perceptual roughness of the coat.
uniform float u_clearcoat_roughness_factor;
#endif

#ifdef HAS_DIELECTRIC
// Reflectance of the base at normal incidence under air, from its refractive index.
uniform float u_dielectric_f0;
#endif

#ifdef HAS_BASE_COLOR_TEXTURE
// Multiplies the base colour. Reads RGBA, stored as sRGB, sampled as linear.
uniform sampler2D u_base_color_texture;
uniform mat3 u_base_color_uv_transform;
uniform int u_base_color_uv_set;
vec2 base_color_uv(vec2 uv0, vec2 uv1) {
    return (u_base_color_uv_transform * vec3(u_base_color_uv_set == 0 ? uv0 : uv1, 1.0)).xy;
}
vec4 sample_base_color(vec2 uv0, vec2 uv1) {
    return texture(u_base_color_texture, base_color_uv(uv0, uv1)).rgba;
}
#endif

#ifdef HAS_METALLIC_ROUGHNESS_TEXTURE
// Multiplies roughness (G) and metalness (B). Reads GB, stored linear.
uniform sampler2D u_metallic_roughness_texture;
uniform mat3 u_metallic_roughness_uv_transform;
uniform int u_metallic_roughness_uv_set;
vec2 metallic_roughness_uv(vec2 uv0, vec2 uv1) {
    return (u_metallic_roughness_uv_transform * vec3(u_metallic_roughness_uv_set == 0 ? uv0 : uv1, 1.0)).xy;
}
vec2 sample_metallic_roughness(vec2 uv0, vec2 uv1) {
    return texture(u_metallic_roughness_texture, metallic_roughness_uv(uv0, uv1)).gb;
}
#endif

#ifdef HAS_NORMAL_TEXTURE
// Multiplies x and y of each sampled normal.
uniform float u_normal_scale;
// Tangent-space normals. Reads RGB, stored linear.
uniform sampler2D u_normal_texture;
uniform mat3 u_normal_uv_transform;
uniform int u_normal_uv_set;
vec2 normal_uv(vec2 uv0, vec2 uv1) {
    return (u_normal_uv_transform * vec3(u_normal_uv_set == 0 ? uv0 : uv1, 1.0)).xy;
}
vec3 sample_normal(vec2 uv0, vec2 uv1) {
    return texture(u_normal_texture, normal_uv(uv0, uv1)).rgb;
}
#endif

#ifdef HAS_OCCLUSION_TEXTURE
// How much of the occlusion applies.
uniform float u_occlusion_strength;
// Ambient occlusion. Reads R, stored linear.
uniform sampler2D u_occlusion_texture;
uniform mat3 u_occlusion_uv_transform;
uniform int u_occlusion_uv_set;
vec2 occlusion_uv(vec2 uv0, vec2 uv1) {
    return (u_occlusion_uv_transform * vec3(u_occlusion_uv_set == 0 ? uv0 : uv1, 1.0)).xy;
}
float sample_occlusion(vec2 uv0, vec2 uv1) {
    return texture(u_occlusion_texture, occlusion_uv(uv0, uv1)).r;
}
#endif

#ifdef HAS_EMISSIVE_TEXTURE
// Multiplies the emission. Reads RGB, stored as sRGB, sampled as linear.
uniform sampler2D u_emissive_texture;
uniform mat3 u_emissive_uv_transform;
uniform int u_emissive_uv_set;
vec2 emissive_uv(vec2 uv0, vec2 uv1) {
    return (u_emissive_uv_transform * vec3(u_emissive_uv_set == 0 ? uv0 : uv1, 1.0)).xy;
}
vec3 sample_emissive(vec2 uv0, vec2 uv1) {
    return texture(u_emissive_texture, emissive_uv(uv0, uv1)).rgb;
}
#endif

#ifdef HAS_SPECULAR_TEXTURE
// Multiplies the factor. Reads A, stored linear.
uniform sampler2D u_specular_texture;
uniform mat3 u_specular_uv_transform;
uniform int u_specular_uv_set;
vec2 specular_uv(vec2 uv0, vec2 uv1) {
    return (u_specular_uv_transform * vec3(u_specular_uv_set == 0 ? uv0 : uv1, 1.0)).xy;
}
float sample_specular(vec2 uv0, vec2 uv1) {
    return texture(u_specular_texture, specular_uv(uv0, uv1)).a;
}
#endif

#ifdef HAS_SPECULAR_COLOR_TEXTURE
// Multiplies the tint. Reads RGB, stored as sRGB, sampled as linear.
uniform sampler2D u_specular_color_texture;
uniform mat3 u_specular_color_uv_transform;
uniform int u_specular_color_uv_set;
vec2 specular_color_uv(vec2 uv0, vec2 uv1) {
    return (u_specular_color_uv_transform * vec3(u_specular_color_uv_set == 0 ? uv0 : uv1, 1.0)).xy;
}
vec3 sample_specular_color(vec2 uv0, vec2 uv1) {
    return texture(u_specular_color_texture, specular_color_uv(uv0, uv1)).rgb;
}
#endif

#ifdef HAS_IRIDESCENCE_TEXTURE
// Multiplies the factor. Reads R, stored linear.
uniform sampler2D u_iridescence_texture;
uniform mat3 u_iridescence_uv_transform;
uniform int u_iridescence_uv_set;
vec2 iridescence_uv(vec2 uv0, vec2 uv1) {
    return (u_iridescence_uv_transform * vec3(u_iridescence_uv_set == 0 ? uv0 : uv1, 1.0)).xy;
}
float sample_iridescence(vec2 uv0, vec2 uv1) {
    return texture(u_iridescence_texture, iridescence_uv(uv0, uv1)).r;
}
#endif

#ifdef HAS_IRIDESCENCE_THICKNESS_TEXTURE
// Thickness between the minimum (0) and the maximum (1). Reads G, stored linear.
uniform sampler2D u_iridescence_thickness_texture;
uniform mat3 u_iridescence_thickness_uv_transform;
uniform int u_iridescence_thickness_uv_set;
vec2 iridescence_thickness_uv(vec2 uv0, vec2 uv1) {
    return (u_iridescence_thickness_uv_transform * vec3(u_iridescence_thickness_uv_set == 0 ? uv0 : uv1, 1.0)).xy;
}
float sample_iridescence_thickness(vec2 uv0, vec2 uv1) {
    return texture(u_iridescence_thickness_texture, iridescence_thickness_uv(uv0, uv1)).g;
}
#endif

#ifdef HAS_BRAGG_TEXTURE
// Multiplies the factor. Reads R, stored linear.
uniform sampler2D u_bragg_texture;
uniform mat3 u_bragg_uv_transform;
uniform int u_bragg_uv_set;
vec2 bragg_uv(vec2 uv0, vec2 uv1) {
    return (u_bragg_uv_transform * vec3(u_bragg_uv_set == 0 ? uv0 : uv1, 1.0)).xy;
}
float sample_bragg(vec2 uv0, vec2 uv1) {
    return texture(u_bragg_texture, bragg_uv(uv0, uv1)).r;
}
#endif

#ifdef HAS_BRAGG_PERIOD_TEXTURE
// Periods of all layers between minimum (0) and maximum (1). Reads G, stored linear.
uniform sampler2D u_bragg_period_texture;
uniform mat3 u_bragg_period_uv_transform;
uniform int u_bragg_period_uv_set;
vec2 bragg_period_uv(vec2 uv0, vec2 uv1) {
    return (u_bragg_period_uv_transform * vec3(u_bragg_period_uv_set == 0 ? uv0 : uv1, 1.0)).xy;
}
float sample_bragg_period(vec2 uv0, vec2 uv1) {
    return texture(u_bragg_period_texture, bragg_period_uv(uv0, uv1)).g;
}
#endif

#ifdef HAS_ANISOTROPY_TEXTURE
// Direction in tangent space (R, G), which the rotation turns further; multiplies the strength (B). Reads RGB, stored linear.
uniform sampler2D u_anisotropy_texture;
uniform mat3 u_anisotropy_uv_transform;
uniform int u_anisotropy_uv_set;
vec2 anisotropy_uv(vec2 uv0, vec2 uv1) {
    return (u_anisotropy_uv_transform * vec3(u_anisotropy_uv_set == 0 ? uv0 : uv1, 1.0)).xy;
}
vec3 sample_anisotropy(vec2 uv0, vec2 uv1) {
    return texture(u_anisotropy_texture, anisotropy_uv(uv0, uv1)).rgb;
}
#endif

#ifdef HAS_TRANSMISSION_TEXTURE
// Multiplies the factor. Reads R, stored linear.
uniform sampler2D u_transmission_texture;
uniform mat3 u_transmission_uv_transform;
uniform int u_transmission_uv_set;
vec2 transmission_uv(vec2 uv0, vec2 uv1) {
    return (u_transmission_uv_transform * vec3(u_transmission_uv_set == 0 ? uv0 : uv1, 1.0)).xy;
}
float sample_transmission(vec2 uv0, vec2 uv1) {
    return texture(u_transmission_texture, transmission_uv(uv0, uv1)).r;
}
#endif

#ifdef HAS_VOLUME_THICKNESS_TEXTURE
// Multiplies the depth. Reads G, stored linear.
uniform sampler2D u_volume_thickness_texture;
uniform mat3 u_volume_thickness_uv_transform;
uniform int u_volume_thickness_uv_set;
vec2 volume_thickness_uv(vec2 uv0, vec2 uv1) {
    return (u_volume_thickness_uv_transform * vec3(u_volume_thickness_uv_set == 0 ? uv0 : uv1, 1.0)).xy;
}
float sample_volume_thickness(vec2 uv0, vec2 uv1) {
    return texture(u_volume_thickness_texture, volume_thickness_uv(uv0, uv1)).g;
}
#endif

#ifdef HAS_SHEEN_COLOR_TEXTURE
// Multiplies the colour. Reads RGB, stored as sRGB, sampled as linear.
uniform sampler2D u_sheen_color_texture;
uniform mat3 u_sheen_color_uv_transform;
uniform int u_sheen_color_uv_set;
vec2 sheen_color_uv(vec2 uv0, vec2 uv1) {
    return (u_sheen_color_uv_transform * vec3(u_sheen_color_uv_set == 0 ? uv0 : uv1, 1.0)).xy;
}
vec3 sample_sheen_color(vec2 uv0, vec2 uv1) {
    return texture(u_sheen_color_texture, sheen_color_uv(uv0, uv1)).rgb;
}
#endif

#ifdef HAS_SHEEN_ROUGHNESS_TEXTURE
// Multiplies the roughness. Reads A, stored linear.
uniform sampler2D u_sheen_roughness_texture;
uniform mat3 u_sheen_roughness_uv_transform;
uniform int u_sheen_roughness_uv_set;
vec2 sheen_roughness_uv(vec2 uv0, vec2 uv1) {
    return (u_sheen_roughness_uv_transform * vec3(u_sheen_roughness_uv_set == 0 ? uv0 : uv1, 1.0)).xy;
}
float sample_sheen_roughness(vec2 uv0, vec2 uv1) {
    return texture(u_sheen_roughness_texture, sheen_roughness_uv(uv0, uv1)).a;
}
#endif

#ifdef HAS_CLEARCOAT_TEXTURE
// Multiplies the factor. Reads R, stored linear.
uniform sampler2D u_clearcoat_texture;
uniform mat3 u_clearcoat_uv_transform;
uniform int u_clearcoat_uv_set;
vec2 clearcoat_uv(vec2 uv0, vec2 uv1) {
    return (u_clearcoat_uv_transform * vec3(u_clearcoat_uv_set == 0 ? uv0 : uv1, 1.0)).xy;
}
float sample_clearcoat(vec2 uv0, vec2 uv1) {
    return texture(u_clearcoat_texture, clearcoat_uv(uv0, uv1)).r;
}
#endif

#ifdef HAS_CLEARCOAT_ROUGHNESS_TEXTURE
// Multiplies the roughness. Reads G, stored linear.
uniform sampler2D u_clearcoat_roughness_texture;
uniform mat3 u_clearcoat_roughness_uv_transform;
uniform int u_clearcoat_roughness_uv_set;
vec2 clearcoat_roughness_uv(vec2 uv0, vec2 uv1) {
    return (u_clearcoat_roughness_uv_transform * vec3(u_clearcoat_roughness_uv_set == 0 ? uv0 : uv1, 1.0)).xy;
}
float sample_clearcoat_roughness(vec2 uv0, vec2 uv1) {
    return texture(u_clearcoat_roughness_texture, clearcoat_roughness_uv(uv0, uv1)).g;
}
#endif

#ifdef HAS_CLEARCOAT_NORMAL_TEXTURE
// Multiplies x and y of each sampled normal.
uniform float u_clearcoat_normal_scale;
// Normals of the coat. Reads RGB, stored linear.
uniform sampler2D u_clearcoat_normal_texture;
uniform mat3 u_clearcoat_normal_uv_transform;
uniform int u_clearcoat_normal_uv_set;
vec2 clearcoat_normal_uv(vec2 uv0, vec2 uv1) {
    return (u_clearcoat_normal_uv_transform * vec3(u_clearcoat_normal_uv_set == 0 ? uv0 : uv1, 1.0)).xy;
}
vec3 sample_clearcoat_normal(vec2 uv0, vec2 uv1) {
    return texture(u_clearcoat_normal_texture, clearcoat_normal_uv(uv0, uv1)).rgb;
}
#endif
