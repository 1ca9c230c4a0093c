// The one place where the base's lobes are mixed, for punctual and for image light.
// Sources: glTF 2.0 Appendix B.2; KHR_materials_specular; KHR_materials_transmission.

#include "lighting/lobe.glsl"
#include "material/layering.glsl"
#include "material/surface.glsl"
#ifdef HAS_TRANSMISSION
#include "material/transmission_layering.glsl"
#endif
#ifdef HAS_IRIDESCENCE  // KHR_materials_iridescence, Implementation Notes
#include "lighting/film.glsl"
#include "material/film_layering.glsl"
#endif

// What white, lossless surfaces would send to the viewer.
struct WhiteLight {
    vec3 diffuse;
    vec3 specular;     // a mirror of the same roughness
#ifdef HAS_TRANSMISSION
    vec3 transmitted;  // a surface that reflects nothing, lit from behind
#endif
};

vec3 plain_reflectance(Lobe lobe, vec3 f0) { return f0 * lobe.slope + lobe.offset; }

#ifdef HAS_DIELECTRIC
Layer dielectric_layer(Surface s, Lobe lobe) {
    vec3 plain = plain_reflectance(lobe, s.dielectric_f0);
#ifdef HAS_IRIDESCENCE
    vec3 film = film_over_dielectric(s, lobe) * (lobe.slope + lobe.offset);
#ifdef LAYERING_SPECULAR
    return iridescent_dielectric_layer_specular(s.iridescence_factor, s.specular_weight, plain, film);
#else
    return iridescent_dielectric_layer(s.iridescence_factor, plain, film);
#endif
#else
    return rgb_mix(s.specular_weight * plain);
#endif
}
#endif

#ifdef HAS_METAL
vec3 metal_reflectance(Surface s, Lobe lobe) {
    vec3 plain = plain_reflectance(lobe, s.base_color);
#ifdef HAS_IRIDESCENCE
    vec3 film = film_over_metal(s, lobe) * (lobe.slope + lobe.offset);
    return iridescent_conductor_layer(s.iridescence_factor, plain, film);
#else
    return plain;
#endif
}
#endif

// Light sent to the viewer. Metal and dielectric are evaluated apart, then mixed.
vec3 mix_lobes(Surface s, Lobe lobe, WhiteLight white) {
    vec3 sent = vec3(0.0);
#ifdef HAS_DIELECTRIC
    Layer layer = dielectric_layer(s, lobe);
#ifdef HAS_TRANSMISSION
    vec3 scattered = (1.0 - s.transmission) * layer.base_weight * white.diffuse;
    vec3 passed = s.transmission * transmitted_share(layer.specular) * white.transmitted;
    sent += (1.0 - s.metallic) * (s.base_color * (scattered + passed) + layer.specular * white.specular);
#else
    sent += (1.0 - s.metallic) * (layer.base_weight * s.base_color * white.diffuse + layer.specular * white.specular);
#endif
#endif
#ifdef HAS_METAL
    sent += s.metallic * metal_reflectance(s, lobe) * white.specular;
#endif
    return sent;
}
