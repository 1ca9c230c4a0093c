// How a reflecting layer is laid over a base, and what a bare metal reflects.
// Twin: gltf_iri/optics/layering.py. The functions take reflectances, not BRDFs: multiply `specular` by D·V for a
// punctual light or by the mirrored radiance for image light, `base_weight` by what the base sends back.

#include "common/math.glsl"
#include "optics/fresnel.glsl"

struct Layer {
    vec3 specular;      // reflectance of the layer
    float base_weight;  // share of the light that reaches the base and comes back
};

// F = F0 + (1 − F0)(1 − |V·H|)⁵
// glTF 2.0 Appendix B.3.4
vec3 conductor_fresnel(vec3 f0, float v_dot_h) { return f_schlick(f0, abs(v_dot_h)); }

// base · (1 − F) + F
// glTF 2.0 Appendix B.3.4
Layer fresnel_mix(float fresnel) { return Layer(vec3(fresnel), 1.0 - fresnel); }

// base · (1 − max(R, G, B)) + colour; 1 − colour would tint the base with the opposite hue.
// KHR_materials_specular, Implementation
Layer rgb_mix(vec3 reflectance) { return Layer(reflectance, 1.0 - max3(reflectance)); }
