// The sheen's directional albedo: E_s = min(∫ D·V·(N·L) dω, 1), lobe by Estevez & Kulla 2017, "Production Friendly
// Microfacet Sheen BRDF". Smooth fibres at grazing angles would send more than arrives: their masking is a fit.

#include "common/math.glsl"
#include "generated/constants.glsl"
#include "lighting/sheen_albedo.glsl"
#include "optics/sheen.glsl"

uniform vec2 u_size;

out float out_albedo;

// N·L in two panels, because the fit bends at ½, by midpoints of s with t = s²(3 − 2s), whose ends weigh nothing;
// N·L = ½ t³ and 1 − ½ t³ crowd the steps where the fit is steep, at 0 and 1.
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
    vec2 arguments = sheen_arguments(gl_FragCoord.xy, u_size);
    float n_dot_v = max(arguments.x, N_DOT_V_MIN);
    float alpha = sheen_alpha(arguments.y);
    float sum = 0.0;
    for (int i = 0; i < COSINE_STEPS; ++i) {
        float s = (float(i) + 0.5) / float(COSINE_STEPS);
        float t = sq(s) * (3.0 - 2.0 * s);
        float grazing = 0.5 * t * sq(t);
        float share = 1.5 * sq(t) * 6.0 * s * (1.0 - s);
        sum += share * (albedo_from(grazing, n_dot_v, alpha) + albedo_from(1.0 - grazing, n_dot_v, alpha));
    }
    out_albedo = min(sum / float(COSINE_STEPS), 1.0);
}
