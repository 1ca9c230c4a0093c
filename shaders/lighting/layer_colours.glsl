// The colours of Bragg layers by the method that the plan chose, and what all methods read of the layers.
// Every method brings `layer_reflected`, `layers_passed` and `layers_entering`, which gltf_iri/evaluation/layers.py asks of
// it in Python.

#include "lighting/view.glsl"
#include "optics/layer_stack.glsl"

uniform float u_bragg_alpha[BRAGG_LAYERS];  // perceptual roughness squared, outermost first
#ifdef BRAGG_BASE
uniform float u_bragg_bent;  // (host's index / index of what the base lies in)²
#endif

float cosine_at_layers(View w) { return cosine_in_host(u_bragg_host_ior, w.n_dot_v); }

#ifdef BRAGG_TABLES
#include "lighting/layer_tables.glsl"
#else
#include "lighting/layers_direct.glsl"
#endif
