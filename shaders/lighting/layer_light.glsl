// Image light as it reaches Bragg layers: as the lobe of each sees it, occlusion included.

struct LayerLight {
    vec3 radiance[BRAGG_LAYERS];  // prefiltered, along the mirror direction
    vec3 metal_radiance;          // the same for the metal below; 0 without one
    vec3 coating_radiance;        // of a mirror: what the host's surface shows; 0 without one
};

LayerLight no_layer_light() {
    LayerLight light;
    for (int i = 0; i < BRAGG_LAYERS; ++i) {
        light.radiance[i] = vec3(0.0);
    }
    light.metal_radiance = light.coating_radiance = vec3(0.0);
    return light;
}
