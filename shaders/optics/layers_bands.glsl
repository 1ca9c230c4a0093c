// Colours of a stack's paths that reflect once, each factor's spectrum as its means over a few bands, which are
// multiplied band by band; what nothing attenuates is summed as a colour.
// Twin: gltf_iri/evaluation/layers_bands.py; gltf_iri/rendering/optics_tables.py fills the table.

#include "optics/layer_stack.glsl"
#include "optics/rough_bragg.glsl"
#include "optics/yeh_spectral.glsl"

// Row 0: each wavelength's part in a band, band after band: 1/λ in two parts, the first of twelve bits, its share of
// the band's mean, and the band. Row 1: the bands' weights, and in the first's fourth their number.
uniform highp sampler2D layer_bands;

const int LAYER_BANDS_MAX = 64;

BraggMirror facet_mirror(float host_ior, BraggLayer layer, float cos_theta) {
    return bragg_mirror(host_ior, layer.n1, layer.n2, layer.d1_nm, layer.d2_nm, layer.cells, cos_theta);
}

int layer_bands_count() { return int(texelFetch(layer_bands, ivec2(0, 1), 0).a + 0.5); }

// means + the bands' means of `base` + `slope`·R; of the mirror's reflectance alone for 0 and 1
void add_means(inout float means[LAYER_BANDS_MAX], BraggMirror mirror, float base, float slope) {
    int parts = textureSize(layer_bands, 0).x;
    for (int i = 0; i < parts; ++i) {
        vec4 part = texelFetch(layer_bands, ivec2(i, 0), 0);
        means[int(part.w)] += part.z * (base + slope * bragg_reflectance(mirror, part.xy));
    }
}

// means · those of T(λ, θ) = ∫ (1 − R(λ, θ_d)) F_α dθ_d
// Fourneau et al. 2024, Eq. 28
void pass_layer(inout float means[LAYER_BANDS_MAX], float host_ior, BraggLayer layer, float cos_theta) {
    int bands = layer_bands_count();
    float passed[LAYER_BANDS_MAX];
    for (int b = 0; b < bands; ++b) passed[b] = 0.0;
    FilterLight light = filter_light(cos_theta, layer.alpha);
    int nodes = filter_count(layer.alpha);
    for (int node = 0; node < nodes; ++node) {
        vec2 met = filter_node(light, node);
        add_means(passed, facet_mirror(host_ior, layer, met.x), met.y, -met.y);
    }
    for (int b = 0; b < bands; ++b) means[b] *= passed[b];
}

// Σ_b W_b means_b Π_{k<above} T_k,b(i) T_k,b(o)
vec3 passed_bands_colour(
    inout float means[LAYER_BANDS_MAX], float host_ior, BraggLayer layers[BRAGG_LAYERS_MAX], int above, float cos_i,
    float cos_o) {
    for (int k = 0; k < above; ++k) {
        pass_layer(means, host_ior, layers[k], cos_i);
        pass_layer(means, host_ior, layers[k], cos_o);
    }
    vec3 colour = vec3(0.0);
    int bands = layer_bands_count();
    for (int b = 0; b < bands; ++b) colour += means[b] * texelFetch(layer_bands, ivec2(b, 1), 0).rgb;
    return colour;
}

// The colour of R_layer(h) Π_{k<layer} T_k(i) T_k(o); cosines in the host
// Fourneau et al. 2024, Eq. 34
vec3 stack_reflected(
    float host_ior, BraggLayer layers[BRAGG_LAYERS_MAX], int layer, float cos_h, float cos_i, float cos_o) {
    BraggLayer met = layers[layer];
    if (layer == 0) {
        return mirror_colour_yeh_spectral(host_ior, met.n1, met.n2, met.d1_nm, met.d2_nm, met.cells, cos_h);
    }
    float means[LAYER_BANDS_MAX];
    int bands = layer_bands_count();
    for (int b = 0; b < bands; ++b) means[b] = 0.0;
    add_means(means, facet_mirror(host_ior, met, cos_h), 0.0, 1.0);
    return passed_bands_colour(means, host_ior, layers, layer, cos_i, cos_o);
}

// The colour of Π_k T_k(i) T_k(o) over the first `count` layers
vec3 stack_passed(float host_ior, BraggLayer layers[BRAGG_LAYERS_MAX], int count, float cos_i, float cos_o) {
    float means[LAYER_BANDS_MAX];
    int bands = layer_bands_count();
    for (int b = 0; b < bands; ++b) means[b] = 1.0;
    return passed_bands_colour(means, host_ior, layers, count, cos_i, cos_o);
}
