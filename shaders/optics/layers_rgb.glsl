// Colours of a stack's paths that reflect once, as products of colours: R_rgb of the mirror method that the define
// names, the truth where none is defined, and T_rgb the filter's mean of 1 − R_rgb.
// Twin: gltf_iri/evaluation/layers_rgb.py.

#include "optics/layer_stack.glsl"
#include "optics/rough_bragg.glsl"
#if defined(METHOD_BLOCH)
#include "optics/bloch.glsl"
#elif defined(METHOD_LANDMARKS)
#include "optics/landmarks.glsl"
#elif defined(METHOD_LANDMARKS_SUB)
#include "optics/landmarks_sub.glsl"
#else
#include "optics/yeh_spectral.glsl"
#endif

vec3 facet_colour(float host_ior, BraggLayer layer, float cos_theta) {
#if defined(METHOD_BLOCH)
    return bragg_reflectance_bloch(
#elif defined(METHOD_LANDMARKS)
    return bragg_reflectance_landmarks(
#elif defined(METHOD_LANDMARKS_SUB)
    return bragg_reflectance_landmarks_sub(
#else
    return mirror_colour_yeh_spectral(
#endif
        host_ior, layer.n1, layer.n2, layer.d1_nm, layer.d2_nm, layer.cells, cos_theta);
}

// ∫ (1 − R_rgb(θ_d)) F_α dθ_d, Fourneau et al. 2024, Eq. 28, of colours
vec3 layer_passed_colour(float host_ior, BraggLayer layer, float cos_theta) {
    vec3 passed = vec3(0.0);
    FilterLight light = filter_light(cos_theta, layer.alpha);
    int nodes = filter_count(layer.alpha);
    for (int node = 0; node < nodes; ++node) {
        vec2 met = filter_node(light, node);
        passed += met.y * (1.0 - facet_colour(host_ior, layer, met.x));
    }
    return passed;
}

// Π_k T_k(i) over the first `count` layers, as colours: of light that crosses them once
vec3 stack_entering(float host_ior, BraggLayer layers[BRAGG_LAYERS_MAX], int count, float cos_i) {
    vec3 colour = vec3(1.0);
    for (int k = 0; k < count; ++k) {
        colour *= layer_passed_colour(host_ior, layers[k], cos_i);
    }
    return colour;
}

// Π_k T_k(i) T_k(o) over the first `count` layers, as colours
vec3 stack_passed(float host_ior, BraggLayer layers[BRAGG_LAYERS_MAX], int count, float cos_i, float cos_o) {
    return stack_entering(host_ior, layers, count, cos_i) * stack_entering(host_ior, layers, count, cos_o);
}

// R_layer(h) Π_{k<layer} T_k(i) T_k(o), as colours; cosines in the host
// Fourneau et al. 2024, Eq. 34
vec3 stack_reflected(
    float host_ior, BraggLayer layers[BRAGG_LAYERS_MAX], int layer, float cos_h, float cos_i, float cos_o) {
    return facet_colour(host_ior, layers[layer], cos_h) * stack_passed(host_ior, layers, layer, cos_i, cos_o);
}
