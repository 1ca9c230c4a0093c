// The sheen's directional albedo: E_s = min(∫ D·V·(N·L) dω, 1), lobe by Estevez & Kulla 2017, "Production Friendly
// Microfacet Sheen BRDF". Smooth fibres at grazing angles would send more than arrives: their masking is a fit.

#include "common/math.glsl"
#include "generated/constants.glsl"
#include "lighting/dfg.glsl"
#include "optics/sheen.glsl"

uniform vec2 u_size;

out float out_albedo;

// N·L in two panels, because the fit bends at ½; t⁶ crowds the steps where it is steep, at N·L = 0 and 1.
const int COSINE_STEPS = 32;
const int TURN_STEPS = 48;  // over half a turn: the other half mirrors it

float albedo_from(float n_dot_l, float n_dot_v, float alpha) {
    float across = sqrt(max((1.0 - sq(n_dot_v)) * (1.0 - sq(n_dot_l)), 0.0));
    float sum = 0.0;
    for (int j = 0; j < TURN_STEPS; ++j) {
        float v_dot_l = across * cos(PI * (float(j) + 0.5) / float(TURN_STEPS)) + n_dot_v * n_dot_l;
        // The floor keeps the half vector of light from straight behind finite.
        sum += d_charlie(min((n_dot_v + n_dot_l) / sqrt(max(2.0 + 2.0 * v_dot_l, 1e-12)), 1.0), alpha);
    }
    return sum / float(TURN_STEPS) * 2.0 * PI * v_sheen(n_dot_l, n_dot_v, alpha) * n_dot_l;
}

void main() {
    vec2 arguments = dfg_arguments(gl_FragCoord.xy, u_size);
    float n_dot_v = max(arguments.x, N_DOT_V_MIN);
    float alpha = max(sq(arguments.y), SHEEN_ALPHA_MIN);
    float sum = 0.0;
    for (int i = 0; i < COSINE_STEPS; ++i) {
        float t = (float(i) + 0.5) / float(COSINE_STEPS);
        float t5 = pow5(t);
        float grazing = 0.5 * t5 * t;
        sum += 3.0 * t5 * (albedo_from(grazing, n_dot_v, alpha) + albedo_from(1.0 - grazing, n_dot_v, alpha));
    }
    out_albedo = min(sum / float(COSINE_STEPS), 1.0);
}
