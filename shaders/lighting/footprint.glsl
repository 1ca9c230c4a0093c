// What a pixel spans. Included at global scope of a fragment shader whose neighbours tell derivatives.

uniform float u_footprint;  // 1; 0: light through the pixel's centre alone, as the CPU reference sees it

// Side of the square over which directions spread as over the pixel's parallelogram: the root of the mean square.
float spread_in_pixel(vec3 direction) {
    vec3 across = dFdx(direction), down = dFdy(direction);
    return u_footprint * sqrt(0.5 * (dot(across, across) + dot(down, down)));
}
