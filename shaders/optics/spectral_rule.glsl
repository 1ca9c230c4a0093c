// The wavelengths that a colour is summed over: rgb = Σ R(λᵢ) wᵢ.
// gltf_iri/rendering/optics_tables.py fills the table with rules of gltf_iri/colour/quadrature.py.

#include "generated/film_constants.glsl"

uniform highp sampler2D spectral_rule;

int spectral_count() { return textureSize(spectral_rule, 0).x; }

// 1/λ in two parts, the first of twelve bits, 1/nm.
vec2 spectral_wavenumber(int i) { return texelFetch(spectral_rule, ivec2(i, 0), 0).xy; }

// The weights of red, green and blue.
vec3 spectral_weight(int i) { return texelFetch(spectral_rule, ivec2(i, 1), 0).rgb; }

// A short rule of SPECTRAL_SMOOTH_COUNT wavelengths, for spectra without fringes: the weights, and 1/λ in 1/nm.
vec4 smooth_node(int i) { return texelFetch(spectral_rule, ivec2(i, 2), 0); }
