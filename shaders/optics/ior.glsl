// Refractive indices from reflectances at normal incidence, and back.
// Twin: gltf_iri/optics/ior.py.

#include "common/math.glsl"

// n = (1 + √F0) / (1 − √F0) = (1 + √F0)² / (1 − F0), under air
// KHR_materials_iridescence, Material Interfaces; the second form: 1 − √F0 rounds away what tells bright metals
// apart, while 1 − F0 is exact above ½.
float fresnel0_to_ior(float f0) { return sq(1.0 + sqrt(f0)) / (1.0 - f0); }
vec3 fresnel0_to_ior(vec3 f0) { return sq(1.0 + sqrt(f0)) / (1.0 - f0); }

// F0 = ((n_t − n_i) / (n_t + n_i))²
// KHR_materials_iridescence, Material Interfaces; x·x where the text has pow(x, 2.0), which GLSL leaves undefined
// for x < 0, that is wherever the light goes into the thinner medium.
float ior_to_fresnel0(float transmitted_ior, float incident_ior) {
    return sq((transmitted_ior - incident_ior) / (transmitted_ior + incident_ior));
}
vec3 ior_to_fresnel0(vec3 transmitted_ior, float incident_ior) {
    return sq((transmitted_ior - incident_ior) / (transmitted_ior + incident_ior));
}
