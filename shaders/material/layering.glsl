// How a film's reflection is mixed into a metal and laid over a dielectric base.
// Twin: gltf_iri/optics/layering.py. The functions take reflectances, not BRDFs: multiply `specular` by D·V for a
// punctual light or by the mirrored radiance for image light, `base_weight` by what the base sends back. For image
// light plain = F0·A + B and film = F·(A + B), with A and B the two terms of the DFG table.

#include "common/math.glsl"
#include "optics/fresnel.glsl"

struct Layer {
    vec3 specular;      // reflectance of the layer
    float base_weight;  // share of the light that reaches the base and comes back
};

// F = F0 + (1 − F0)(1 − |V·H|)⁵
// glTF 2.0 Appendix B.2.1
vec3 conductor_fresnel(vec3 f0, float v_dot_h) { return f_schlick(f0, abs(v_dot_h)); }

// base · (1 − F) + F
// glTF 2.0 Appendix B.2.2
Layer fresnel_mix(float fresnel) { return Layer(vec3(fresnel), 1.0 - fresnel); }

// base · (1 − max(R, G, B)) + colour; 1 − colour would tint the base with the opposite hue.
// KHR_materials_iridescence and KHR_materials_specular, Implementation
Layer rgb_mix(vec3 reflectance) { return Layer(reflectance, 1.0 - max3(reflectance)); }

// mix(plain, film, strength)
// KHR_materials_iridescence, Implementation Notes, Metal Base Material
vec3 iridescent_conductor_layer(float strength, vec3 plain, vec3 film) { return mix(plain, film, strength); }

// Without KHR_materials_specular the bare and the filmed surface are layered, then mixed.
// KHR_materials_iridescence, Implementation Notes, Dielectric Base Material
Layer iridescent_dielectric_layer(float strength, vec3 plain, vec3 film) {
    Layer bare = rgb_mix(plain);
    Layer filmed = rgb_mix(film);
    return Layer(
        mix(bare.specular, filmed.specular, strength), mix(bare.base_weight, filmed.base_weight, strength));
}

// With KHR_materials_specular the reflectances are mixed, then layered once; the weight is in the film's base F0.
// KHR_materials_iridescence, Implementation Notes, Dielectric Base Material, second function
Layer iridescent_dielectric_layer_specular(float strength, float specular_weight, vec3 plain, vec3 film) {
    return rgb_mix(mix(specular_weight * plain, film, strength));
}
