// The DFG table: A = ⟨(1 − Fc) G⟩, B = ⟨Fc G⟩, Fc = (1 − V·H)⁵ (Karis 2013, "Real Shading in Unreal Engine 4"), and
// the mean cosine ⟨V·H G⟩/⟨G⟩.
// The quadrature is that of `facet_cosines` in gltf_iri/optics/facet_mean.py, which says why it is smooth.

#include "common/math.glsl"
#include "generated/constants.glsl"
#include "lighting/dfg.glsl"
#include "optics/microfacet.glsl"

uniform vec2 u_size;
// Gauss points and weights of ∫₀¹: over the slope of the facets, for each of two panels, and over half a turn.
uniform vec2 u_slopes[24];
uniform vec2 u_turns[8];

out vec4 out_terms;  // the last is of no meaning: RGB32F need not be drawn into

// Light of facets from x = low to high, tan θ = α tan x, and the same times V·H.
vec3 panel(float n_dot_v, float alpha, float low, float high) {
    float sin_v = sqrt(1.0 - sq(n_dot_v));
    vec3 sum = vec3(0.0);
    for (int i = 0; i < u_slopes.length(); ++i) {
        // x runs as sin², which takes the square root out of φ_max at the ends of the panels.
        float ramp = 0.5 * PI * u_slopes[i].x;
        float x = low + (high - low) * sq(sin(ramp));
        float dx = (high - low) * PI * sin(ramp) * cos(ramp) * u_slopes[i].y;
        vec2 facet = vec2(cos(x), alpha * sin(x));  // cos θ, sin θ, once of length 1
        facet = normalize(facet);
        // Facets whose mirror direction lies below the surface send nothing. The floor stands for 0/0 where V or
        // the facet lies along N: there every φ counts.
        float limit = n_dot_v * (2.0 * sq(facet.y) - 1.0) / max(2.0 * sin_v * facet.x * facet.y, 1e-30);
        float phi_max = acos(clamp(limit, -1.0, 1.0));
        vec3 ring = vec3(0.0);
        for (int j = 0; j < u_turns.length(); ++j) {
            float v_dot_h = sin_v * facet.y * cos(phi_max * u_turns[j].x) + n_dot_v * facet.x;
            float n_dot_l = max(2.0 * v_dot_h * facet.x - n_dot_v, 0.0);  // rounding may put the last a hair below
            float sent = v_smith_ggx_correlated(n_dot_l, n_dot_v, alpha) * n_dot_l * v_dot_h / facet.x;
            float grazing = pow5(1.0 - v_dot_h);
            ring += u_turns[j].y * sent * vec3(1.0 - grazing, grazing, v_dot_h);
        }
        // D·cosθ·sinθ dθ = sin x cos x dx / π, for both halves of the turn.
        sum += 8.0 / PI * sin(x) * cos(x) * dx * phi_max * ring;
    }
    return sum;
}

void main() {
    vec2 arguments = dfg_arguments(gl_FragCoord.xy, u_size);
    float n_dot_v = clamp(arguments.x, N_DOT_V_MIN, 1.0);
    float alpha = clamp(sq(arguments.y), ALPHA_MIN, 1.0);
    // tan(π/4 ± θ_v/2), between which φ_max leaves half a turn.
    float steep = (1.0 + sqrt(1.0 - sq(n_dot_v))) / n_dot_v;
    float middle = atan(1.0 / (steep * alpha)), end = atan(steep / alpha);
    vec3 terms = panel(n_dot_v, alpha, 0.0, middle) + panel(n_dot_v, alpha, middle, end);
    // The larger divisor takes back what rounding may have added to a sum of ones.
    out_terms.xy = terms.xy / max(1.0, terms.x + terms.y);
    out_terms.zw = vec2(terms.z / (terms.x + terms.y), 0.0);
}
