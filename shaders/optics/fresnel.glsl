// Fresnel reflectance, Schlick's approximation.
// Twin: gltf_iri/optics/fresnel.py.

#include "common/math.glsl"

// F = F0 + (1 − F0)(1 − cosθ)⁵
// Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering", Eq. 15
float f_schlick(float f0, float cos_theta) { return f0 + (1.0 - f0) * pow5(1.0 - cos_theta); }
vec3 f_schlick(vec3 f0, float cos_theta) { return f0 + (1.0 - f0) * pow5(1.0 - cos_theta); }
