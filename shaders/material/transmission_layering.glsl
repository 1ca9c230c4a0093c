// What a reflecting layer leaves for light that passes through.
// Twin: gltf_iri/optics/layering.py.

// T = clamp(1 − R, 0, 1), colour by colour: what is reflected is not transmitted. The text's formula may
// give R beyond 1, where 1 − R would take light away from behind.
vec3 transmitted_share(vec3 reflectance) { return clamp(1.0 - reflectance, 0.0, 1.0); }
