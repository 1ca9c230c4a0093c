// The material at one point: every property after its textures, as glTF 2.0 §3.9 and the extensions combine them.

#include "common/math.glsl"
#include "generated/material.glsl"
#ifndef HAS_UNLIT
#include "optics/microfacet.glsl"
#endif
#ifdef HAS_IRIDESCENCE_THICKNESS_SPREAD
#include "material/thickness.glsl"
#endif

struct Surface {
    vec3 base_color;
    float alpha;            // coverage
    vec3 emission;
    float metallic;
    float perceptual_roughness;
    float alpha_roughness;  // `alpha_ggx` of it
    float occlusion;
    vec3 dielectric_f0;     // before the specular weight
    float specular_weight;
#ifdef HAS_IRIDESCENCE
    float iridescence_factor;
    float film_ior;
    float iridescence_thickness_nm;
#ifdef HAS_IRIDESCENCE_THICKNESS_SPREAD
    float iridescence_thickness_std_nm;  // within the pixel
#endif
#endif
#ifdef HAS_BRAGG
    float bragg_factor;
    float bragg_period_texel;  // along which the periods of all layers run
#endif
#ifdef HAS_ANISOTROPY
    float anisotropy_strength;
    vec2 anisotropy_direction;  // along tangent and bitangent, unit
#endif
#ifdef HAS_TRANSMISSION
    float transmission;
#ifdef HAS_VOLUME
    float volume_thickness_m;   // in the mesh's own space
#endif
#endif
#ifdef HAS_SHEEN
    vec3 sheen_color;
    float sheen_roughness;      // perceptual
#endif
#ifdef HAS_CLEARCOAT
    float clearcoat;
    float clearcoat_roughness;  // perceptual
#endif
};

Surface gather_surface(vec2 uv0, vec2 uv1, vec4 vertex_colour) {
    Surface s;

    vec4 base = u_base_color_factor * vertex_colour;
#ifdef HAS_BASE_COLOR_TEXTURE
    base *= sample_base_color(uv0, uv1);
#endif
    s.base_color = clamp(base.rgb, 0.0, 1.0);  // vertex colours above 1 would reflect more than arrives
    s.alpha = base.a;

    s.emission = vec3(0.0);
#ifdef HAS_EMISSION
    s.emission = u_emissive_factor;
#ifdef HAS_EMISSIVE_TEXTURE
    s.emission *= sample_emissive(uv0, uv1);
#endif
#endif

    s.metallic = 0.0;
    s.perceptual_roughness = 1.0;
    s.alpha_roughness = 1.0;
#ifndef HAS_UNLIT
    s.metallic = u_metallic_factor;
    s.perceptual_roughness = u_roughness_factor;
#ifdef HAS_METALLIC_ROUGHNESS_TEXTURE
    vec2 roughness_metallic = sample_metallic_roughness(uv0, uv1);
    s.perceptual_roughness *= roughness_metallic.x;
    s.metallic *= roughness_metallic.y;
#endif
    s.alpha_roughness = alpha_ggx(s.perceptual_roughness);
#endif

    s.occlusion = 1.0;
#ifdef HAS_OCCLUSION_TEXTURE
    s.occlusion += u_occlusion_strength * (sample_occlusion(uv0, uv1) - 1.0);
#endif

    s.dielectric_f0 = vec3(0.0);
    s.specular_weight = 1.0;
#ifdef HAS_DIELECTRIC
    s.dielectric_f0 = vec3(u_dielectric_f0);
#ifdef HAS_SPECULAR
    s.specular_weight = u_specular_factor;
    s.dielectric_f0 *= u_specular_color_factor;
#ifdef HAS_SPECULAR_TEXTURE
    s.specular_weight *= sample_specular(uv0, uv1);
#endif
#ifdef HAS_SPECULAR_COLOR_TEXTURE
    s.dielectric_f0 *= sample_specular_color(uv0, uv1);
#endif
    s.dielectric_f0 = min(s.dielectric_f0, vec3(1.0));  // the tint may exceed 1, a reflectance may not
#endif
#endif

#ifdef HAS_IRIDESCENCE
    s.iridescence_factor = u_iridescence_factor;
#ifdef HAS_IRIDESCENCE_TEXTURE
    s.iridescence_factor *= sample_iridescence(uv0, uv1);
#endif
    s.film_ior = u_iridescence_film_ior;
    s.iridescence_thickness_nm = u_iridescence_thickness_max_nm;
#ifdef HAS_IRIDESCENCE_THICKNESS_TEXTURE
#ifdef HAS_IRIDESCENCE_THICKNESS_SPREAD
    vec2 in_pixel = thickness_in_pixel(iridescence_thickness_uv(uv0, uv1));
    float thickness = in_pixel.x;
    s.iridescence_thickness_std_nm =
        abs(u_iridescence_thickness_max_nm - u_iridescence_thickness_min_nm) * in_pixel.y;
#else
    float thickness = sample_iridescence_thickness(uv0, uv1);
#endif
    s.iridescence_thickness_nm = mix(u_iridescence_thickness_min_nm, u_iridescence_thickness_max_nm, thickness);
#endif
#endif

#ifdef HAS_BRAGG
    s.bragg_factor = u_bragg_factor;
#ifdef HAS_BRAGG_TEXTURE
    s.bragg_factor *= sample_bragg(uv0, uv1);
#endif
    s.bragg_period_texel = 1.0;
#ifdef HAS_BRAGG_PERIOD_TEXTURE
    s.bragg_period_texel = sample_bragg_period(uv0, uv1);
#endif
#endif

#ifdef HAS_ANISOTROPY
    s.anisotropy_strength = u_anisotropy_strength;
    s.anisotropy_direction = vec2(1.0, 0.0);
#ifdef HAS_ANISOTROPY_TEXTURE
    vec3 anisotropy = sample_anisotropy(uv0, uv1);
    s.anisotropy_strength *= anisotropy.z;
    vec2 painted = anisotropy.xy * 2.0 - 1.0;
    // Where opposite directions are filtered into none, the tangent stands in.
    s.anisotropy_direction = dot(painted, painted) > 0.0 ? normalize(painted) : s.anisotropy_direction;
#endif
    float cos_turn = cos(u_anisotropy_rotation_rad), sin_turn = sin(u_anisotropy_rotation_rad);
    s.anisotropy_direction = mat2(cos_turn, sin_turn, -sin_turn, cos_turn) * s.anisotropy_direction;
#endif

#ifdef HAS_TRANSMISSION
    s.transmission = u_transmission_factor;
#ifdef HAS_TRANSMISSION_TEXTURE
    s.transmission *= sample_transmission(uv0, uv1);
#endif
#ifdef HAS_VOLUME
    s.volume_thickness_m = u_volume_thickness_factor_m;
#ifdef HAS_VOLUME_THICKNESS_TEXTURE
    s.volume_thickness_m *= sample_volume_thickness(uv0, uv1);
#endif
#endif
#endif

#ifdef HAS_SHEEN
    s.sheen_color = u_sheen_color_factor;
#ifdef HAS_SHEEN_COLOR_TEXTURE
    s.sheen_color *= sample_sheen_color(uv0, uv1);
#endif
    s.sheen_roughness = u_sheen_roughness_factor;
#ifdef HAS_SHEEN_ROUGHNESS_TEXTURE
    s.sheen_roughness *= sample_sheen_roughness(uv0, uv1);
#endif
#endif

#ifdef HAS_CLEARCOAT
    s.clearcoat = u_clearcoat_factor;
#ifdef HAS_CLEARCOAT_TEXTURE
    s.clearcoat *= sample_clearcoat(uv0, uv1);
#endif
    s.clearcoat_roughness = u_clearcoat_roughness_factor;
#ifdef HAS_CLEARCOAT_ROUGHNESS_TEXTURE
    s.clearcoat_roughness *= sample_clearcoat_roughness(uv0, uv1);
#endif
#endif
    return s;
}
