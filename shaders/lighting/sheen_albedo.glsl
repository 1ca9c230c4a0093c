// The table of the sheen's directional albedo E_s, kept over √(N·V) and sheen roughness like the DFG table.
// Made by shaders/pass/sheen_albedo.frag.

#include "lighting/dfg.glsl"

uniform sampler2D u_sheen_albedo;  // bound where a material of the scene has sheen, also without an environment

// Share of a white sky that white fibres send to the viewer, at most 1. Twin: gltf_iri/optics/sheen.py.
float sheen_albedo(sampler2D table, float n_dot_v, float sheen_roughness) {
    return dfg_terms(table, n_dot_v, sheen_roughness).r;
}
