// How light and viewer see the layers of a stack: through its smooth coating, where the host is not air.
// Twin: gltf_iri/optics/layer_stack.py.

#include "common/math.glsl"
#include "generated/bragg_constants.glsl"

// gltf_iri/evaluation/layers.py; a stack is an array of BRAGG_LAYERS_MAX, outermost first.
struct BraggLayer {
    float n1;
    float n2;
    float d1_nm;
    float d2_nm;
    float cells;
    float alpha;
};

// What the layers see of light and viewer; cosines in the host. passage is T(i) T(o) / n_h².
struct Sight {
    float cos_i;
    float cos_o;
    float cos_h;
    float n_cross_h_squared;
    float passage;
};

// cosθ' = √(1 − (1 − c²)/n_h²), Snell's law from air
float cosine_in_host(float host_ior, float cos_theta) {
    float inside = sqrt((host_ior - 1.0) * (host_ior + 1.0) + sq(cos_theta)) / host_ior;
    return host_ior == 1.0 ? cos_theta : min(inside, 1.0);  // rounding may lift it above 1, which has no sine
}

// T = ½(T_s + T_p) of the step from air into the host, T = 4Y₁Y₂/(Y₁ + Y₂)², Y = q (s) and q/n² (p)
float coating_transmittance(float host_ior, float cos_theta) {
    float inside = host_ior * cosine_in_host(host_ior, cos_theta);
    float outside_p = sq(host_ior) * cos_theta;
    // Along a surface without a step nothing is mirrored.
    if (!(inside > 0.0)) return 1.0;
    return 2.0 * inside * (cos_theta / sq(cos_theta + inside) + outside_p / sq(outside_p + inside));
}

// i·o = c_i c_o + s_i s_o cosφ, i·h = √(½(1 + i·o)), |n×h|² = |s_i + s_o e^{iφ}|² / (2(1 + i·o))
// cos_phi : of the turn between light and viewer about the normal, −1 at the mirrored light's
Sight sight_of(float host_ior, float cos_theta_i, float cos_theta_o, float cos_phi) {
    float cos_i = cosine_in_host(host_ior, cos_theta_i);
    float cos_o = cosine_in_host(host_ior, cos_theta_o);
    // From outside: cosines of small angles have lost their digits once they are rounded.
    float sin_i = sqrt((1.0 - cos_theta_i) * (1.0 + cos_theta_i)) / host_ior;
    float sin_o = sqrt((1.0 - cos_theta_o) * (1.0 + cos_theta_o)) / host_ior;
    float turn = 1.0 + cos_phi;
    float product = sin_i * sin_o;
    // 1 + cos(θ_i + θ_o), as (c_i + c_o)²/(1 + cos(θ_i − θ_o)), and what turns out of the plane
    float total = sq(cos_i + cos_o) / (1.0 + cos_i * cos_o + product) + product * turn;
    // s_i − s_o = (c_o² − c_i²)/(n_h² (s_i + s_o)), which keeps its digits next to the mirror direction
    float sines = sq(host_ior) * (sin_i + sin_o);
    float step_ = sines > 0.0 ? (cos_theta_o - cos_theta_i) * (cos_theta_o + cos_theta_i) / sines : 0.0;
    float tilt = sq(step_) + 2.0 * product * turn;
    // 0/0 where both graze from opposite sides: no facet is met.
    float sine_squared = total > 0.0 ? min(tilt / (2.0 * total), 1.0) : 0.0;
    float passage = coating_transmittance(host_ior, cos_theta_i) * coating_transmittance(host_ior, cos_theta_o);
    return Sight(cos_i, cos_o, sqrt(0.5 * total), sine_squared, host_ior == 1.0 ? 1.0 : passage / sq(host_ior));
}
