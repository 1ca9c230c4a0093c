// E(N) / π: what a white diffuse surface sends back under the environment; a white environment gives 1.
// E(N) = ∫ L(ω) max(N·ω, 0) dω, glTF 2.0 Appendix B.2.3's diffuse BRDF; one term a texel of a small level.

#include "lighting/equirect.glsl"

uniform sampler2D u_environment;
uniform int u_level;
uniform vec2 u_size;  // of the picture that is drawn

out vec4 out_irradiance;

void main() {
    vec3 normal = direction_from_equirect(gl_FragCoord.xy / u_size);
    ivec2 size = textureSize(u_environment, u_level);
    vec3 sum = vec3(0.0);
    float weight = 0.0;
    for (int y = 0; y < size.y; ++y) {
        // Rows cover cos v₁ − cos v₂ = 2 sin v sin(½ π / height) of the sphere: only sin v differs.
        float row_weight = sin((float(y) + 0.5) / float(size.y) * PI);
        for (int x = 0; x < size.x; ++x) {
            vec3 direction = direction_from_equirect((vec2(x, y) + 0.5) / vec2(size));
            float share = max(dot(normal, direction), 0.0) * row_weight;
            sum += share * texelFetch(u_environment, ivec2(x, y), u_level).rgb;
            weight += share;
        }
    }
    // Divided by what a white environment sums to, not by π, so that white stays white to the last bit.
    out_irradiance = vec4(sum / weight, 1.0);
}
