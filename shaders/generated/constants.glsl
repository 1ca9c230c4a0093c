// Constants of the Python package. Written by gltf_iri.generate; do not edit.

// gltf_iri/optics/microfacet.py
const float ALPHA_MIN = 0.001;
const float N_DOT_V_MIN = 0.0001;

// gltf_iri/scene/light.py
const float LIGHT_DISTANCE_MIN_M = 1e-06;

// gltf_iri/rendering/environment_light.py
const int LAYERS_PER_LEVEL = 3;
const int ROUGHNESS_LAYERS = 9;
const float LAYER_ROUGHNESS_MIN = 0.0625;
