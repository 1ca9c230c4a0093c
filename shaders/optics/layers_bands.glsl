// Colours of a stack's paths that reflect once, each factor's spectrum as its means over a few bands, which are
// multiplied band by band; what nothing attenuates is summed as a colour.
// Twin: gltf_iri/evaluation/layers_bands.py; gltf_iri/rendering/optics_tables.py fills the table.

#include "optics/layer_waves.glsl"
#include "optics/yeh_spectral.glsl"

// Four bands a row, the last filled up with 0: what each wavelength of the coarse rule adds to their means, and in
// three columns more their weights in red, green and blue.
uniform highp sampler2D layer_bands;

const int BAND_QUADS_MAX = 16;

int band_quads() { return textureSize(layer_bands, 0).y; }

void band_means(out vec4 means[BAND_QUADS_MAX], vec4 spectrum[LAYER_QUADS_MAX]) {
    int count = coarse_count();
    int rows = band_quads();
    for (int row = 0; row < rows; ++row) {
        means[row] = vec4(0.0);
        for (int i = 0; i < count; ++i) means[row] += spectrum[i / 4][i & 3] * texelFetch(layer_bands, ivec2(i, row), 0);
    }
}

// Σ_b W_b Π_{k<above} T_k,b(i) T_k,b(o), times R_above,b(h) where `reflects`; of one way instead of two without T_k,b(o)
vec3 path_colour(
    float host_ior, BraggLayer layers[BRAGG_LAYERS_MAX], int above, bool reflects, int ways, float cos_h, float cos_i,
    float cos_o) {
    int rows = band_quads();
    vec4 means[BAND_QUADS_MAX];
    for (int row = 0; row < rows; ++row) means[row] = vec4(1.0);
    for (int factor = reflects ? 0 : 1; factor <= 2 * above; factor += 3 - ways) {
        vec4 spectrum[LAYER_QUADS_MAX];
        path_factor(spectrum, factor, host_ior, layers, above, cos_h, cos_i, cos_o);
        vec4 each[BAND_QUADS_MAX];
        band_means(each, spectrum);
        for (int row = 0; row < rows; ++row) means[row] *= each[row];
    }
    vec3 colour = vec3(0.0);
    int first = coarse_count();
    for (int row = 0; row < rows; ++row) {
        colour += vec3(dot(means[row], texelFetch(layer_bands, ivec2(first, row), 0)),
                       dot(means[row], texelFetch(layer_bands, ivec2(first + 1, row), 0)),
                       dot(means[row], texelFetch(layer_bands, ivec2(first + 2, row), 0)));
    }
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
    return path_colour(host_ior, layers, layer, true, 2, cos_h, cos_i, cos_o);
}

// The colour of Π_k T_k(i) T_k(o) over the first `count` layers
vec3 stack_passed(float host_ior, BraggLayer layers[BRAGG_LAYERS_MAX], int count, float cos_i, float cos_o) {
    return path_colour(host_ior, layers, count, false, 2, 1.0, cos_i, cos_o);
}

// The colour of Π_k T_k(i) over the first `count` layers: of light that crosses them once
vec3 stack_entering(float host_ior, BraggLayer layers[BRAGG_LAYERS_MAX], int count, float cos_i) {
    return path_colour(host_ior, layers, count, false, 1, 1.0, cos_i, cos_i);
}
