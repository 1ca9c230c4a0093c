// Colours of a stack's paths that reflect once, each factor a spectrum: multiplied at each wavelength, then summed.
// Twin: gltf_iri/evaluation/layers_single.py, which refines its rules; here they are fixed, the filter's to
// FILTER_POINTS a panel and the wavelengths to those of the table. llvmpipe ends all loops of a shader after 65535
// iterations without a word: there it holds for about 100 wavelengths through one layer of 30 cells.

#include "optics/bragg.glsl"
#include "optics/layer_stack.glsl"
#include "optics/rough_bragg.glsl"
#include "optics/spectral_rule.glsl"

// So many wavelengths at once: a facet's mirror is set up once for all of them.
const int LAYER_WAVES = 16;

BraggMirror facet_mirror(float host_ior, BraggLayer layer, float cos_theta) {
    return bragg_mirror(host_ior, layer.n1, layer.n2, layer.d1_nm, layer.d2_nm, layer.cells, cos_theta);
}

// share · T(λ, θ), T = ∫ (1 − R(λ, θ_d)) F_α dθ_d
// Fourneau et al. 2024, Eq. 28
void pass_layer(inout float share[LAYER_WAVES], int first, float host_ior, BraggLayer layer, float cos_theta) {
    float passed[LAYER_WAVES];
    for (int w = 0; w < LAYER_WAVES; ++w) passed[w] = 0.0;
    FilterLight light = filter_light(cos_theta, layer.alpha);
    int nodes = filter_count(layer.alpha);
    for (int node = 0; node < nodes; ++node) {
        vec2 met = filter_node(light, node);
        BraggMirror mirror = facet_mirror(host_ior, layer, met.x);
        for (int w = 0; w < LAYER_WAVES; ++w) {
            passed[w] += met.y * (1.0 - bragg_reflectance(mirror, spectral_wavenumber(first + w)));
        }
    }
    for (int w = 0; w < LAYER_WAVES; ++w) share[w] *= passed[w];
}

// The colour of Π_{k<above} T_k(i) T_k(o), times R_above(h) where `reflects`
vec3 single_reflection_colour(
    float host_ior, BraggLayer layers[BRAGG_LAYERS_MAX], int above, bool reflects, float cos_h, float cos_i,
    float cos_o) {
    vec3 colour = vec3(0.0);
    int count = spectral_count();
    for (int first = 0; first < count; first += LAYER_WAVES) {
        float share[LAYER_WAVES];
        for (int w = 0; w < LAYER_WAVES; ++w) share[w] = 1.0;
        if (reflects) {
            BraggMirror mirror = facet_mirror(host_ior, layers[above], cos_h);
            for (int w = 0; w < LAYER_WAVES; ++w) share[w] = bragg_reflectance(mirror, spectral_wavenumber(first + w));
        }
        for (int k = 0; k < above; ++k) {
            pass_layer(share, first, host_ior, layers[k], cos_i);
            pass_layer(share, first, host_ior, layers[k], cos_o);
        }
        for (int w = 0; w < min(LAYER_WAVES, count - first); ++w) colour += share[w] * spectral_weight(first + w);
    }
    return colour;
}

// The colour of R_layer(h) Π_{k<layer} T_k(i) T_k(o); cosines in the host
// Fourneau et al. 2024, Eq. 34
vec3 stack_reflected(
    float host_ior, BraggLayer layers[BRAGG_LAYERS_MAX], int layer, float cos_h, float cos_i, float cos_o) {
    return single_reflection_colour(host_ior, layers, layer, true, cos_h, cos_i, cos_o);
}

// The colour of Π_k T_k(i) T_k(o) over the first `count` layers
vec3 stack_passed(float host_ior, BraggLayer layers[BRAGG_LAYERS_MAX], int count, float cos_i, float cos_o) {
    return single_reflection_colour(host_ior, layers, count, false, 1.0, cos_i, cos_o);
}
