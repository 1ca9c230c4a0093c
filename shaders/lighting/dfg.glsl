// Where the DFG table keeps (N·V, perceptual roughness): texel centres from edge to edge, ⁴√(N·V) across and
// √roughness down, each from where it is no longer held at its least; the table bends most at grazing angles and
// near mirrors.

#include "generated/constants.glsl"

uniform sampler2D u_dfg;  // bound wherever a surface is shaded, also without an environment

const vec2 DFG_FIRST = vec2(sqrt(sqrt(N_DOT_V_MIN)), sqrt(sqrt(ALPHA_MIN)));  // √roughness = ⁴√α

vec2 dfg_arguments(vec2 pixel, vec2 size) {
    vec2 x = mix(DFG_FIRST, vec2(1.0), (pixel - 0.5) / (size - 1.0));
    return vec2(x.x * x.x * x.x * x.x, x.y * x.y);
}

// (A, B, mean V·H): a rough mirror under a white environment reflects F0·A + B, and its facets send that at this
// mean cosine. Twins: gltf_iri/optics/dfg.py, gltf_iri/optics/facet_mean.py.
vec3 dfg_facets(sampler2D table, float n_dot_v, float perceptual_roughness) {
    vec2 size = vec2(textureSize(table, 0));
    vec2 x = max(vec2(sqrt(sqrt(n_dot_v)), sqrt(perceptual_roughness)), DFG_FIRST);
    return texture(table, ((x - DFG_FIRST) / (1.0 - DFG_FIRST) * (size - 1.0) + 0.5) / size).rgb;
}

vec2 dfg_terms(sampler2D table, float n_dot_v, float perceptual_roughness) {
    return dfg_facets(table, n_dot_v, perceptual_roughness).rg;
}
