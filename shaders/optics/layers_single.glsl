// Colours of a stack's paths that reflect once, each factor a spectrum: multiplied at each wavelength, then summed.
// Twin: gltf_iri/evaluation/layers_single.py, which refines its rules; here they are fixed, the filter's to
// FILTER_POINTS a panel and the wavelengths to those of the table. Of 60 random pairs of layers those rules err by a
// CIEDE2000 of 0.5 in what the second reflects and 0.6 in what passes both (95th percentile, up to ten cells), and of
// up to thirty cells by 1.0 and 1.9.

#include "optics/layer_waves.glsl"

// Π_{k<above} T_k(i) T_k(o); of one way instead of two Π_{k<above} T_k(i)
void passed_spectrum(out vec4 spectrum[LAYER_QUADS_MAX], float host_ior, BraggLayer layers[BRAGG_LAYERS_MAX],
                     int above, int ways, float cos_i, float cos_o) {
    int quads = layer_quads();
    for (int quad = 0; quad < quads; ++quad) spectrum[quad] = vec4(1.0);
    for (int factor = 1; factor <= 2 * above; factor += 3 - ways) {
        vec4 each[LAYER_QUADS_MAX];
        path_factor(each, factor, host_ior, layers, above, 1.0, cos_i, cos_o);
        for (int quad = 0; quad < quads; ++quad) spectrum[quad] *= each[quad];
    }
}

// The colour of R_layer(h) Π_{k<layer} T_k(i) T_k(o); cosines in the host
// Fourneau et al. 2024, Eq. 34; R has fringes that all wavelengths together resolve, T is straight between each fourth.
vec3 stack_reflected(
    float host_ior, BraggLayer layers[BRAGG_LAYERS_MAX], int layer, float cos_h, float cos_i, float cos_o) {
    vec4 passed[LAYER_QUADS_MAX];
    passed_spectrum(passed, host_ior, layers, layer, 2, cos_i, cos_o);
    BraggMirror mirror = facet_mirror(host_ior, layers[layer], cos_h);
    vec3 colour = vec3(0.0);
    int count = spectral_count();
    for (int i = 0; i < count; ++i) {
        int before = i / 4;
        int after = min(before + 1, coarse_count() - 1);
        float share = mix(passed[before / 4][before & 3], passed[after / 4][after & 3], 0.25 * float(i & 3));
        colour += share * bragg_reflectance(mirror, spectral_wavenumber(i)) * spectral_weight(i);
    }
    return colour;
}

vec3 passed_colour(float host_ior, BraggLayer layers[BRAGG_LAYERS_MAX], int count, int ways, float cos_i, float cos_o) {
    vec4 passed[LAYER_QUADS_MAX];
    passed_spectrum(passed, host_ior, layers, count, ways, cos_i, cos_o);
    vec3 colour = vec3(0.0);
    int wavelengths = coarse_count();
    for (int i = 0; i < wavelengths; ++i) colour += passed[i / 4][i & 3] * coarse_weight(i);
    return colour;
}

// The colour of Π_k T_k(i) T_k(o) over the first `count` layers
vec3 stack_passed(float host_ior, BraggLayer layers[BRAGG_LAYERS_MAX], int count, float cos_i, float cos_o) {
    return passed_colour(host_ior, layers, count, 2, cos_i, cos_o);
}

// The colour of Π_k T_k(i) over the first `count` layers: of light that crosses them once
vec3 stack_entering(float host_ior, BraggLayer layers[BRAGG_LAYERS_MAX], int count, float cos_i) {
    return passed_colour(host_ior, layers, count, 1, cos_i, cos_i);
}
