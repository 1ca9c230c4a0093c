// The environment as diffuse surfaces send it back, integrated over an even grid: ∫ L (N·L) dω / π, the diffuse
// BRDF of glTF 2.0 Appendix B.2.3.

#include "lighting/equirect.glsl"

uniform sampler2D u_environment;
uniform ivec2 u_layer_size;

out vec4 out_radiance;

const ivec2 GRID = ivec2(64, 32);

void main() {
    vec3 normal = direction_of_texel(gl_FragCoord.xy, vec2(u_layer_size));
    float level = log2(max(float(textureSize(u_environment, 0).y) / float(GRID.y), 1.0));
    vec3 sum = vec3(0.0);
    float weight = 0.0;
    for (int y = 0; y < GRID.y; ++y) {
        // Rows cover cos v₁ − cos v₂ = 2 sin v sin(½ π / height) of the sphere: only sin v differs.
        float row_weight = sin((float(y) + 0.5) / float(GRID.y) * PI);
        for (int x = 0; x < GRID.x; ++x) {
            vec2 uv = (vec2(x, y) + 0.5) / vec2(GRID);
            float share = max(dot(normal, direction_from_equirect(uv)), 0.0) * row_weight;
            sum += share * textureLod(u_environment, uv, level).rgb;
            weight += share;
        }
    }
    // Divided by what a white environment sums to, so that white stays white to the last bit.
    out_radiance = vec4(sum / weight, 1.0);
}
