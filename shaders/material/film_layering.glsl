// How a film's reflection is mixed into a metal and laid over a dielectric base.
// Twin: gltf_iri/optics/layering.py. For image light plain = F0·A + B and film = F·(A + B), with A and B the two
// terms of the DFG table.

#include "material/layering.glsl"

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
