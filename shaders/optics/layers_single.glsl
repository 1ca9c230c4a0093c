// Colours of a stack's paths that reflect once, each factor a spectrum: multiplied at each wavelength, then summed.
// Twin: gltf_iri/evaluation/layers_single.py, which refines its rules; here they are fixed, the filter's to
// FILTER_POINTS a panel and the wavelengths to those of the tables.

#include "optics/layer_waves.glsl"
#include "optics/yeh_spectral.glsl"

// spectrum · Π_{k<above} T_k(i) T_k(o)
void pass_layers(
    inout vec4 spectrum[LAYER_QUADS_MAX], float host_ior, BraggLayer layers[BRAGG_LAYERS_MAX], int above, float cos_i,
    float cos_o) {
    int quads = layer_quads();
    for (int side = 0; side < 2 * above; ++side) {
        vec4 passed[LAYER_QUADS_MAX];
        layer_passed(passed, host_ior, layers[side / 2], (side & 1) == 0 ? cos_i : cos_o);
        for (int quad = 0; quad < quads; ++quad) spectrum[quad] *= passed[quad];
    }
}

vec3 spectrum_colour(vec4 spectrum[LAYER_QUADS_MAX]) {
    vec3 colour = vec3(0.0);
    int count = coarse_count();
    for (int i = 0; i < count; ++i) colour += spectrum[i / 4][i & 3] * coarse_weight(i);
    return colour;
}

// The colour of R_layer(h) Π_{k<layer} T_k(i) T_k(o); cosines in the host
// Fourneau et al. 2024, Eq. 34; what nothing attenuates is summed over all wavelengths.
vec3 stack_reflected(
    float host_ior, BraggLayer layers[BRAGG_LAYERS_MAX], int layer, float cos_h, float cos_i, float cos_o) {
    BraggLayer met = layers[layer];
    if (layer == 0) {
        return mirror_colour_yeh_spectral(host_ior, met.n1, met.n2, met.d1_nm, met.d2_nm, met.cells, cos_h);
    }
    vec4 spectrum[LAYER_QUADS_MAX];
    BraggMirror mirror = facet_mirror(host_ior, met, cos_h);
    int quads = layer_quads();
    for (int quad = 0; quad < quads; ++quad) spectrum[quad] = facet_reflectance(mirror, quad);
    pass_layers(spectrum, host_ior, layers, layer, cos_i, cos_o);
    return spectrum_colour(spectrum);
}

// The colour of Π_k T_k(i) T_k(o) over the first `count` layers
vec3 stack_passed(float host_ior, BraggLayer layers[BRAGG_LAYERS_MAX], int count, float cos_i, float cos_o) {
    vec4 spectrum[LAYER_QUADS_MAX];
    int quads = layer_quads();
    for (int quad = 0; quad < quads; ++quad) spectrum[quad] = vec4(1.0);
    pass_layers(spectrum, host_ior, layers, count, cos_i, cos_o);
    return spectrum_colour(spectrum);
}
