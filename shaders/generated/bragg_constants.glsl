// Constants of rough Bragg layers in Python. Written by gltf_iri.generate; do not edit.

// gltf_iri/optics/rough_bragg.py, filter_nodes: points of one panel, and of all three
const int FILTER_POINTS = 12;
const int FILTER_NODES = 36;
const float FILTER_INSIDE[12] = float[12](0.000209720729, 0.0056603013, 0.0323050095, 0.101425985, 0.226913675, 0.402275049, 0.597724951, 0.773086325, 0.898574015, 0.967694991, 0.994339699, 0.999790279);
const float FILTER_WEIGHTS[12] = float[12](0.00107302543, 0.0126021453, 0.0444586838, 0.0963441837, 0.153616268, 0.191905694, 0.191905694, 0.153616268, 0.0963441837, 0.0444586838, 0.0126021453, 0.00107302543);

// gltf_iri/rendering/optics_tables.py
const int COARSE_COUNT = 129;

// gltf_iri/material/bragg.py
const int BRAGG_LAYERS_MAX = 4;
