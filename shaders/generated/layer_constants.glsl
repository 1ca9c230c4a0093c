// Constants of the layers over the base in Python. Written by gltf_iri.generate; do not edit.

// gltf_iri/optics/sheen.py
const float SHEEN_ALPHA_MIN = 0.005;
const float SHEEN_FIT_AT_0[5] = float[5](25.3245, 3.32435, 0.16801, -1.27393, -4.85967);
const float SHEEN_FIT_AT_1[5] = float[5](21.5473, 3.82987, 0.19823, -1.9776, -4.32054);

// gltf_iri/optics/layering.py
const float CLEARCOAT_F0 = 0.04;

// gltf_iri/rendering/environment_light.py
const int SHEEN_LAYERS = 5;
