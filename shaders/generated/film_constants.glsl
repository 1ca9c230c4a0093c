// Constants of the film methods in Python. Written by gltf_iri.generate; do not edit.

// gltf_iri/colour/sensitivity.py: lobes of x̄, ȳ, z̄, and the second lobe of x̄
const vec3 SENSITIVITY_AMPLITUDE = vec3(0.846590002, 1.00022189, 1.00112249);
const vec3 SENSITIVITY_WAVELENGTH_NM = vec3(594.883998, 557.00997, 452.816519);
const vec3 SENSITIVITY_LENGTH_NM = vec3(2419.28226, 1649.95188, 1957.26858);
const float SENSITIVITY_SECOND_AMPLITUDE = 0.153868307;
const float SENSITIVITY_SECOND_WAVELENGTH_NM = 446.448502;
const float SENSITIVITY_SECOND_LENGTH_NM = 2365.14261;
const vec3 SENSITIVITY_WHITE = vec3(1.20536875, 0.948319498, 0.91000965);

// gltf_iri/colour/spaces.py: the text's matrix, by columns
const mat3 XYZ_TO_REC709 = mat3(
    vec3(3.2404542, -0.969266, 0.0556434),
    vec3(-1.5371385, 1.8760108, -0.2040259),
    vec3(-0.4985314, 0.041556, 1.0572252)
);

// gltf_iri/evaluation/khr.py
const float F0_OFFSET = 0.0001;
const float R123_MIN = 1e-05;
const float R123_MAX = 0.9999;

// gltf_iri/evaluation/khr_guarded.py
const float MAX_F0 = 0.9999;
const float MAX_R123 = 0.9999;
const float MATCHED_F0 = 0.005;
const float THIN_OPD_NM = 100.0;

// gltf_iri/rendering/optics_tables.py
const float SENSITIVITY_FINE_PER_NM = 4.0;
const float SENSITIVITY_FINE_END_NM = 4096.125;
const float SENSITIVITY_LAST = 76289.0;
const float SENSITIVITY_UNIT = 7.4505806e-10;
const float SENSITIVITY_SLOPE_UNIT = 2.09547579e-12;
const uint SENSITIVITY_SLOPE_SHIFT = 21u;
const int SENSITIVITY_ROW = 1024;
const int SENSITIVITY_ROW_BITS = 10;
const int SENSITIVITY_ROWS = 75;
const int SPECTRAL_SMOOTH_COUNT = 33;

// gltf_iri/rendering/spread_table.py, and gltf_iri/colour/damped_sensitivity.py
const float SPREAD_FINE_END_NM = 4096.5;
const float SPREAD_FAR_PER_NM = 0.25;
const float SPREAD_LAST = 19073.0;
const float SPREAD_UNIT = 7.4505806e-10;
const float SPREAD_SLOPE_UNIT = 8.38190317e-12;
const uint SPREAD_SLOPE_SHIFT = 20u;
const int SPREAD_ROW = 1024;
const int SPREAD_ROW_BITS = 10;
const int SPREAD_ROWS = 19;
const int SPREADS = 26;
const float SPREAD_SQUARED_MAX = 230400.0;
const float SPREAD_SQUARED_SCALE = 42025.0;
const float SPREAD_PART_MAX = 0.845737359;
const vec3 DAMPING_PER_NM2 = vec3(5.48311356e-05, 6.64563885e-05, 9.53469813e-05);

// gltf_iri/optics/granier_heidrich.py
const vec3 LAYER_WAVELENGTHS_NM = vec3(645.0, 525.0, 445.0);

// gltf_iri/optics/landmarks.py, and gltf_iri/colour/observer.py: what is visible
const int LANDMARK_MODES_MAX = 256;
const float SHORTEST_NM = 360.0;
const float LONGEST_NM = 830.0;

// gltf_iri/evaluation/fourier.py
const float FOURIER_THIN_OPD_NM = 20.0;
const int FOURIER_ORDERS = 3200;
