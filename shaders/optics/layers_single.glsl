// Colours of a stack's paths that reflect once, each factor a spectrum: multiplied at each wavelength, then summed.
// Twin: gltf_iri/evaluation/layers_single.py, which refines its rules; here they are fixed, the filter's to
// FILTER_POINTS a panel and the wavelengths to those of the tables.

#include "optics/layer_waves.glsl"
#include "optics/yeh_spectral.glsl"

// The colour of Π_{k<above} T_k(i) T_k(o), times R_above(h) where `reflects`
vec3 path_colour(
    float host_ior, BraggLayer layers[BRAGG_LAYERS_MAX], int above, bool reflects, float cos_h, float cos_i,
    float cos_o) {
    int quads = layer_quads();
    vec4 spectrum[LAYER_QUADS_MAX];
    for (int quad = 0; quad < quads; ++quad) spectrum[quad] = vec4(1.0);
    for (int factor = reflects ? 0 : 1; factor <= 2 * above; ++factor) {
        vec4 each[LAYER_QUADS_MAX];
        path_factor(each, factor, host_ior, layers, above, cos_h, cos_i, cos_o);
        for (int quad = 0; quad < quads; ++quad) spectrum[quad] *= each[quad];
    }
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
    return path_colour(host_ior, layers, layer, true, cos_h, cos_i, cos_o);
}

// The colour of Π_k T_k(i) T_k(o) over the first `count` layers
vec3 stack_passed(float host_ior, BraggLayer layers[BRAGG_LAYERS_MAX], int count, float cos_i, float cos_o) {
    return path_colour(host_ior, layers, count, false, 1.0, cos_i, cos_o);
}
