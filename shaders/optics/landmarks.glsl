// A Bragg mirror's colour from boxes between the landmarks of its spectrum, for many cells.
// Twin: gltf_iri/evaluation/landmarks.py, which says what of it goes beyond the paper.

#include "generated/film_constants.glsl"
#include "optics/cumulative_colour.glsl"
#include "optics/landmark_search.glsl"
#include "optics/refraction.glsl"

const float LANDMARK_SUBDIVISIONS_MAX = 5.0;
const float LANDMARK_LEAST_PATH_NM = 1e-12; // stands for a cell without thickness
const float LANDMARK_LEAST_INDEX = 1e-18;   // stands for light along the films

// Reflectances r² of s and p between media a and b, then 1 − r², of indices n and q = n cosθ; tangential is (n sinθ)²
// Fresnel; as products, which keep their digits for equal media and at Brewster's angle
vec4 interface_shares(float n_a, float q_a, float n_b, float q_b, float tangential) {
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

// One polarisation of a mirror: r₁₂², w̃, and reflectance and transmittance from the host into n1.
struct Polarisation {
    float r_squared;
    float weight;
    float host_r;
    float host_t;
};

// What a band's boxes let through, weighed by the eye; the interface to the host without interference
// Fourneau et al. 2024, Eq. 14-16; a landmark at t lies at slope · t + shift steps of the table
vec3 band_transmittance(vec3 band, float rho, Polarisation beam, int parts, float slope, float shift) {
    float last_step = float(cumulative_steps());
    float zero = zero_point(band, rho);
    vec4 ends = vec4(band.x, min(band.y, zero), max(band.y, zero), band.z);
    vec3 total = vec3(0.0);
    vec3 below = vec3(0.0);
    bool has_below = false;
    for (int piece = 0; piece < 3; ++piece) {
        float low = ends[piece];
        float width = (ends[piece + 1] - low) / float(parts);
        if (width <= 0.0) continue;
        float at_low = slope * low + shift;
        float at_step = slope * width;
        if (at_low >= last_step || at_low + at_step * float(parts) <= 0.0) continue;
        below = has_below ? below : cumulative_at(at_low);
        has_below = true;
        for (int part = 0; part < parts; ++part) {
            vec3 above = cumulative_at(at_low + at_step * float(part + 1));
            float envelope = envelope_transmittance(low + width * (float(part) + 0.5), rho, beam.r_squared);
            float through = 1.0 - beam.weight * (1.0 - envelope);
            through *= beam.host_t / max(beam.host_t + beam.host_r * through, LANDMARK_TINY);
            total += through * (above - below);
            below = above;
        }
    }
    return total;
}

// The sum over the visible bands of s and p
vec3 landmark_transmittance(
    float path_nm, float rho, Polarisation s, Polarisation p, float subdivisions, int newton_steps) {
    float steps_nm =
        float(cumulative_steps()) / (1.0 / SHORTEST_NM - 1.0 / LONGEST_NM);
    float first = floor(2.0 * path_nm / LONGEST_NM);
    float last = floor(2.0 * path_nm / SHORTEST_NM);
    // Thicker cells show more gaps than are searched: each band then stands for the `stride` from it on.
    float stride = 1.0 + floor((last - first) / float(LANDMARK_MODES_MAX));
    float scale = 0.5 * steps_nm / path_nm;
    int halvings = newton_steps > 0 ? 0 : LANDMARK_HALVINGS;
    vec3 total = vec3(0.0);
    for (int i = 0; i <= LANDMARK_MODES_MAX; ++i) {
        float m = first + stride * float(i);
        if (m > last) break;
        BandPhases phases = band_phases(m, rho);
        vec3 band_s = landmark_band(m, rho, s.r_squared, phases, newton_steps);
        vec3 band_p = landmark_band(m, rho, p.r_squared, phases, newton_steps);
        vec3 halved_s = halved_band(m, rho, s.r_squared, halvings);
        vec3 halved_p = halved_band(m, rho, p.r_squared, halvings);
        band_s = newton_steps > 0 ? band_s : halved_s;
        band_p = newton_steps > 0 ? band_p : halved_p;
        int parts = int(clamp(subdivisions - m, 1.0, LANDMARK_SUBDIVISIONS_MAX));
        float shift = (m - stride * m) * scale - steps_nm / LONGEST_NM;
        total += band_transmittance(band_s, rho, s, parts, stride * scale, shift);
        total += band_transmittance(band_p, rho, p, parts, stride * scale, shift);
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
    vec2 inside = has_both ? interface_shares(n1, q1, n2, q2, tangential).xy : vec2(0.0);
    vec4 outside = interface_shares(host_ior, q_h, n1, q1, tangential);

    float at_normal = 0.735 * sq((n1 - n2) / (n1 + n2)) + 0.532;
    float weight = at_normal + (1.0 - at_normal) * sq(1.0 - q1 / n1);

    Polarisation s = Polarisation(inside.x, weight, outside.x, outside.z);
    Polarisation p = Polarisation(inside.y, weight, outside.y, outside.w);
    int newton_steps = min(int(cumulative_parameter(1) + 0.5), LANDMARK_NEWTON_MAX);
    return 1.0 - 0.5 * landmark_transmittance(path_nm, rho, s, p, cumulative_parameter(0), newton_steps);
}
