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

// A coarse rule of each fourth wavelength, for what is averaged over angles; COARSE_COUNT at most.
int coarse_count() { return (spectral_count() + 3) / 4; }
vec2 coarse_wavenumber(int i) { return spectral_wavenumber(4 * min(i, coarse_count() - 1)); }
vec3 coarse_weight(int i) { return texelFetch(spectral_rule, ivec2(i, 3), 0).rgb; }
