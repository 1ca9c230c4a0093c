// The one place where the lobes are mixed, for punctual and for image light.
// Sources: glTF 2.0 Appendix B.2; KHR_materials_specular.

#include "material/layering.glsl"
#include "material/surface.glsl"
#ifdef HAS_IRIDESCENCE  // KHR_materials_iridescence, Implementation Notes
#include "lighting/film.glsl"
#include "material/film_layering.glsl"
#endif

// How a lobe turns F0 into a reflectance: plain = F0·slope + offset, film = F(cosθ)·(slope + offset).
// A facet at V·H has slope 1 − w and offset w, w = (1 − V·H)⁵ (Schlick); image light has the DFG table's A and B.
struct Lobe {
    float cos_theta;  // the film's outside angle
    float slope;
    float offset;
};

Lobe facet_lobe(float v_dot_h) {
    float grazing = pow5(1.0 - v_dot_h);
    return Lobe(v_dot_h, 1.0 - grazing, grazing);
}

vec3 plain_reflectance(Lobe lobe, vec3 f0) { return f0 * lobe.slope + lobe.offset; }

#ifdef HAS_DIELECTRIC
// The film's base has the specular weight in its F0.
Layer dielectric_layer(Surface s, Lobe lobe) {
    vec3 plain = plain_reflectance(lobe, s.dielectric_f0);
#ifdef HAS_IRIDESCENCE
    vec3 film = film_fresnel(s, s.specular_weight * s.dielectric_f0, lobe.cos_theta) * (lobe.slope + lobe.offset);
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
    vec3 film = film_fresnel(s, s.base_color, lobe.cos_theta) * (lobe.slope + lobe.offset);
    return iridescent_conductor_layer(s.iridescence_factor, plain, film);
#else
    return plain;
#endif
}
#endif

// Light sent to the viewer. diffuse: what a white diffuse surface would send; specular: what a white mirror of the
// same roughness would send. Metal and dielectric are evaluated apart, then mixed.
vec3 mix_lobes(Surface s, Lobe lobe, vec3 diffuse, vec3 specular) {
    vec3 sent = vec3(0.0);
#ifdef HAS_DIELECTRIC
    Layer layer = dielectric_layer(s, lobe);
    sent += (1.0 - s.metallic) * (layer.base_weight * s.base_color * diffuse + layer.specular * specular);
#endif
#ifdef HAS_METAL
    sent += s.metallic * metal_reflectance(s, lobe) * specular;
#endif
    return sent;
}
