// `landmarks` with the boxes of the first bands cut finer; its table says how fine.
// Twin: gltf_iri/evaluation/landmarks.py.

#include "optics/landmarks.glsl"

// Boxes of the band above the mode m come in max(1, s − m)
// Fourneau et al. 2024, §3.2.2
vec3 bragg_reflectance_landmarks_sub(
    float host_ior, float n1, float n2, float d1_nm, float d2_nm, float cells, float cos_theta_h) {
    return bragg_reflectance_landmarks(host_ior, n1, n2, d1_nm, d2_nm, cells, cos_theta_h);
}
