// A Bragg mirror's colour from boxes between the landmarks of its spectrum, for many cells.
// Twin: gltf_iri/evaluation/landmarks.py, which says what of it goes beyond the paper.

#include "optics/cumulative_colour.glsl"
#include "optics/landmark_search.glsl"
#include "optics/refraction.glsl"

const int LANDMARK_MODES_MAX = 256;
const float LANDMARK_SUBDIVISIONS_MAX = 5.0;
const float LANDMARK_LEAST_PATH_NM = 1e-12; // stands for a cell without thickness
const float LANDMARK_LEAST_INDEX = 1e-18;   // stands for light along the films
const float CUMULATIVE_SHORTEST_NM = 360.0;
const float CUMULATIVE_LONGEST_NM = 830.0;

// Reflectances r² of s and p between media a and b, then 1 − r², of indices n and q = n cosθ; tangential is (n sinθ)²
// Fresnel; as products, which keep their digits for equal media and at Brewster's angle
vec4 interface_power(float n_a, float q_a, float n_b, float q_b, float tangential) {
    float aa = n_a * n_a;
    float bb = n_b * n_b;
    float sum_s = q_a + q_b;
    float sum_p = aa * q_b + bb * q_a;
    float contrast = (n_a - n_b) * (n_a + n_b);
    float r_s = contrast / (sum_s * sum_s);
    float r_p = contrast * ((aa * bb - tangential * (aa + bb)) / (sum_p * sum_p));
    vec2 t = vec2(4.0 * q_a * q_b / (sum_s * sum_s), 4.0 * (aa * q_b) * (bb * q_a) / (sum_p * sum_p));
    return vec4(min(vec2(r_s * r_s, r_p * r_p), 1.0), t);
}

// What the boxes of one polarisation let through, weighed by the eye
// Fourneau et al. 2024, Eq. 14-16; host_r and host_t: into n1, without interference
vec3 landmark_transmittance(
    float path_nm, float rho, float r_squared, float weight, float host_r, float host_t,
    float subdivisions, int newton_steps) {
    float last_step = float(cumulative_steps());
    float steps_nm = last_step / (1.0 / CUMULATIVE_SHORTEST_NM - 1.0 / CUMULATIVE_LONGEST_NM);
    float first = floor(2.0 * path_nm / CUMULATIVE_LONGEST_NM);
    float last = floor(2.0 * path_nm / CUMULATIVE_SHORTEST_NM);
    // Thicker cells show more gaps than are searched: each band then stands for the `stride` from it on.
    float stride = 1.0 + floor((last - first) / float(LANDMARK_MODES_MAX));
    float scale = 0.5 * steps_nm / path_nm;
    vec3 total = vec3(0.0);
    for (int i = 0; i <= LANDMARK_MODES_MAX; ++i) {
        float m = first + stride * float(i);
        if (m > last) break;
        vec3 band = landmark_band(m, rho, r_squared, newton_steps);
        float zero = zero_point(band, rho);
        vec4 ends = vec4(band.x, min(band.y, zero), max(band.y, zero), band.z);
        float parts = max(1.0, subdivisions - m);
        float shift = (m - stride * m) * scale - steps_nm / CUMULATIVE_LONGEST_NM;
        for (int piece = 0; piece < 3; ++piece) {
            float low = ends[piece];
            float width = (ends[piece + 1] - low) / parts;
            float at_low = stride * scale * low + shift;
            float at_step = stride * scale * width;
            if (width <= 0.0 || at_low >= last_step || at_low + at_step * parts <= 0.0) continue;
            vec3 below = cumulative_at(at_low);
            for (float part = 0.0; part < LANDMARK_SUBDIVISIONS_MAX; ++part) {
                if (part >= parts) break;
                vec3 above = cumulative_at(at_low + at_step * (part + 1.0));
                float envelope = envelope_transmittance(low + width * (part + 0.5), rho, r_squared);
                float through = 1.0 - weight * (1.0 - envelope);
                total += host_t * through / max(host_t + host_r * through, LANDMARK_TINY) * (above - below);
                below = above;
            }
        }
    }
    return total;
}

// rgb = 1 − ½ Σ of what s and p let through; the number of cells does not enter
// Fourneau et al. 2024, §3.2 and Appendix B; the table says how finely boxes are cut and how roots are found
vec3 bragg_reflectance_landmarks(
    float host_ior, float n1, float n2, float d1_nm, float d2_nm, float cells, float cos_theta_h) {
    float q1_squared = normal_index_squared(n1, host_ior, cos_theta_h);
    float q2_squared = normal_index_squared(n2, host_ior, cos_theta_h);
    if (q1_squared < 0.0 || q2_squared < 0.0) {
        return vec3(1.0);
    }
    float q1 = max(sqrt(q1_squared), LANDMARK_LEAST_INDEX);
    float q2 = max(sqrt(q2_squared), LANDMARK_LEAST_INDEX);
    float q_h = max(host_ior * cos_theta_h, LANDMARK_LEAST_INDEX);
    float tangential = sq(host_ior) * (1.0 - cos_theta_h) * (1.0 + cos_theta_h);

    float path_nm = max(q1 * d1_nm + q2 * d2_nm, LANDMARK_LEAST_PATH_NM);
    float rho = (q1 * d1_nm - q2 * d2_nm) / path_nm;
    // Without one of its films a cell has no interface; also towards grazing light, where r₁₂² nears 1.
    bool has_both = q1 * d1_nm > 0.0 && q2 * d2_nm > 0.0;
    vec2 inside = has_both ? interface_power(n1, q1, n2, q2, tangential).xy : vec2(0.0);
    vec4 outside = interface_power(host_ior, q_h, n1, q1, tangential);

    float at_normal = 0.735 * sq((n1 - n2) / (n1 + n2)) + 0.532;
    float weight = at_normal + (1.0 - at_normal) * sq(1.0 - q1 / n1);

    float subdivisions = cumulative_parameter(0);
    int newton_steps = int(cumulative_parameter(1) + 0.5);
    vec3 through_s = landmark_transmittance(
        path_nm, rho, inside.x, weight, outside.x, outside.z, subdivisions, newton_steps);
    vec3 through_p = landmark_transmittance(
        path_nm, rho, inside.y, weight, outside.y, outside.w, subdivisions, newton_steps);
    return 1.0 - 0.5 * (through_s + through_p);
}
