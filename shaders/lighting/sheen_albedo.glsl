// The table of the sheen's directional albedo E_s: ⁴√(N·V) across, for the fibres' masking bends most at grazing
// angles, and sheen roughness from where α is no longer held at its least, texel centres from edge to edge.
// Made by gltf_iri/rendering/lobe_tables.py.

#include "generated/layer_constants.glsl"

uniform sampler2D u_sheen_albedo;  // bound where a material of the scene has sheen, also without an environment

const float SHEEN_ROUGHNESS_MIN = sqrt(SHEEN_ALPHA_MIN);

// Share of a white sky that white fibres send to the viewer, at most 1. Twin: gltf_iri/optics/sheen.py.
float sheen_albedo(sampler2D table, float n_dot_v, float sheen_roughness) {
    vec2 size = vec2(textureSize(table, 0));
    float row = max(sheen_roughness - SHEEN_ROUGHNESS_MIN, 0.0) / (1.0 - SHEEN_ROUGHNESS_MIN);
    return texture(table, (vec2(sqrt(sqrt(n_dot_v)), row) * (size - 1.0) + 0.5) / size).r;
}
