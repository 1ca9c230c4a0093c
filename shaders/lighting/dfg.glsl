// Where the DFG table keeps (N·V, perceptual roughness): texel centres from edge to edge, and √(N·V) across, for
// the table bends most at grazing angles.

vec2 dfg_arguments(vec2 pixel, vec2 size) {
    vec2 x = (pixel - 0.5) / (size - 1.0);
    return vec2(x.x * x.x, x.y);
}

uniform sampler2D u_dfg;  // bound wherever a surface is shaded, also without an environment

// (A, B): a rough mirror under a white environment reflects F0·A + B.
vec2 dfg_terms(sampler2D table, float n_dot_v, float perceptual_roughness) {
    vec2 size = vec2(textureSize(table, 0));
    vec2 x = vec2(sqrt(n_dot_v), perceptual_roughness);
    return texture(table, (x * (size - 1.0) + 0.5) / size).rg;
}
