// Sines and cosines of angles counted in turns. Whole turns come off before π is multiplied in: a phase of some
// hundred radians loses digits that the fraction of a turn still has.
// Twin: gltf_iri/optics/turns.py.

#include "common/math.glsl"

// sin(2πt) and cos(2πt)
vec2 sincos_turns(float turns) {
    float angle = 2.0 * PI * (turns - floor(turns + 0.5));
    return vec2(sin(angle), cos(angle));
}

// cos(2πt + shift)
vec3 cos_turns(vec3 turns, vec3 shift) {
    vec3 fraction = turns - floor(turns + 0.5);
    return cos(2.0 * PI * fraction + shift);
}
