// The wavelengths that a colour is summed over: rgb = Σ R(λᵢ) wᵢ.
// gltf_iri/rendering/optics_tables.py fills the table with a rule of gltf_iri/colour/quadrature.py.

uniform highp sampler2D spectral_rule;

int spectral_count() { return textureSize(spectral_rule, 0).x; }

// 1/λ in two parts, the first of twelve bits, 1/nm.
vec2 spectral_wavenumber(int i) { return texelFetch(spectral_rule, ivec2(i, 0), 0).xy; }

// The weights of red, green and blue.
vec3 spectral_weight(int i) { return texelFetch(spectral_rule, ivec2(i, 1), 0).rgb; }
