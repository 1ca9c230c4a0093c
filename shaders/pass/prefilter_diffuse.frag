// The environment as diffuse surfaces send it back, integrated texel by texel over a small level: ∫ L (N·L) dω / π,
// the diffuse BRDF of glTF 2.0 Appendix B.2.3.

#include "lighting/equirect.glsl"

uniform sampler2D u_environment;
uniform int u_level;
uniform ivec2 u_layer_size;

out vec4 out_radiance;

void main() {
    vec3 normal = direction_of_texel(gl_FragCoord.xy, vec2(u_layer_size));
    ivec2 size = textureSize(u_environment, u_level);
    vec3 sum = vec3(0.0);
    float weight = 0.0;
    for (int y = 0; y < size.y; ++y) {
        // Rows cover cos v₁ − cos v₂ = 2 sin v sin(½ π / height) of the sphere: only sin v differs.
        float row_weight = sin((float(y) + 0.5) / float(size.y) * PI);
        for (int x = 0; x < size.x; ++x) {
            float n_dot_l = dot(normal, direction_from_equirect((vec2(x, y) + 0.5) / vec2(size)));
            float share = max(n_dot_l, 0.0) * row_weight;
            sum += share * texelFetch(u_environment, ivec2(x, y), u_level).rgb;
            weight += share;
        }
    }
    // Divided by what a white environment sums to, so that white stays white to the last bit.
    out_radiance = vec4(sum / weight, 1.0);
}
