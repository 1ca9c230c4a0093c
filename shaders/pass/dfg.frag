// The DFG table: A = ⟨(1 − Fc) G⟩, B = ⟨Fc G⟩ over the facets that the viewer sees, Fc = (1 − V·H)⁵.
// Karis 2013, "Real Shading in Unreal Engine 4"; facets by Dupuy & Benyoub 2023, "Sampling Visible GGX Normals with
// Spherical Caps", Listing 3. Each visible facet then weighs G₂/G₁ ≤ 1, so A + B never exceeds 1.

#include "common/math.glsl"
#include "generated/constants.glsl"
#include "lighting/dfg.glsl"

uniform vec2 u_size;

out vec2 out_terms;

const int CAP_STEPS = 64;
const int TURN_STEPS = 24;  // over half a turn: the other half mirrors it

// Λ = ½ (√(1 + α² tan²θ) − 1), Heitz 2014, Eq. 72
float smith_lambda(float cos_theta, float alpha) {
    return 0.5 * (sqrt(1.0 + sq(alpha) * (1.0 / sq(cos_theta) - 1.0)) - 1.0);
}

void main() {
    vec2 arguments = dfg_arguments(gl_FragCoord.xy, u_size);
    float n_dot_v = max(arguments.x, N_DOT_V_MIN);
    float alpha = max(sq(arguments.y), ALPHA_MIN);
    vec3 v = vec3(sqrt(1.0 - sq(n_dot_v)), 0.0, n_dot_v);
    vec3 v_stretched = normalize(vec3(alpha * v.xy, v.z));
    float lambda_v = smith_lambda(n_dot_v, alpha);

    vec2 sum = vec2(0.0);
    for (int i = 0; i < CAP_STEPS; ++i) {
        // The rest of the cap shrinks as t², with weight 2t: the few facets far off the normal lie at its end.
        float t = (float(i) + 0.5) / float(CAP_STEPS);
        float z = 1.0 - (1.0 - sq(t)) * (1.0 + v_stretched.z);
        float radius = sqrt(max(1.0 - sq(z), 0.0));  // rounding may leave z slightly below −1
        vec2 ring = vec2(0.0);
        for (int j = 0; j < TURN_STEPS; ++j) {
            float turn = PI * (float(j) + 0.5) / float(TURN_STEPS);
            vec3 h_stretched = vec3(radius * cos(turn), radius * sin(turn), z) + v_stretched;
            vec3 h = normalize(vec3(alpha * h_stretched.xy, h_stretched.z));
            float v_dot_h = dot(v, h);
            float n_dot_l = 2.0 * v_dot_h * h.z - v.z;
            if (n_dot_l > 0.0) {
                float seen = (1.0 + lambda_v) / (1.0 + lambda_v + smith_lambda(n_dot_l, alpha));
                float fc = pow5(1.0 - v_dot_h);
                ring += seen * vec2(1.0 - fc, fc);
            }
        }
        sum += 2.0 * t * ring / float(TURN_STEPS);
    }
    // The larger divisor takes back what rounding may have added to a sum of ones.
    out_terms = sum / max(float(CAP_STEPS), sum.x + sum.y);
}
