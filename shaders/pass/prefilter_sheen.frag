// The environment as fibres send it back, integrated texel by texel over a small level; layers of growing sheen
// roughness, evenly from 0 to 1, one below the other: ∫ L D V (N·L) dω / ∫ D V (N·L) dω with N = V, which is right
// where the viewer faces the surface. Lobe by Estevez & Kulla 2017.

#include "generated/constants.glsl"
#include "lighting/equirect.glsl"
#include "optics/sheen.glsl"

uniform sampler2D u_environment;
uniform int u_level;
uniform ivec2 u_layer_size;

out vec4 out_radiance;

void main() {
    int layer = int(gl_FragCoord.y) / u_layer_size.y;
    float alpha = max(sq(float(layer) / float(SHEEN_LAYERS - 1)), SHEEN_ALPHA_MIN);
    vec3 normal = direction_of_texel(gl_FragCoord.xy, vec2(u_layer_size));
    ivec2 size = textureSize(u_environment, u_level);
    vec3 sum = vec3(0.0);
    float weight = 0.0;
    for (int y = 0; y < size.y; ++y) {
        // Rows cover cos v₁ − cos v₂ = 2 sin v sin(½ π / height) of the sphere: only sin v differs.
        float row_weight = sin((float(y) + 0.5) / float(size.y) * PI);
        for (int x = 0; x < size.x; ++x) {
            float n_dot_l = dot(normal, direction_from_equirect((vec2(x, y) + 0.5) / vec2(size)));
            if (n_dot_l > 0.0) {
                // With N = V, H is halfway to L: (N·H)² = (1 + N·L) / 2.
                float share = d_charlie(sqrt(0.5 + 0.5 * min(n_dot_l, 1.0)), alpha) *
                              v_sheen(min(n_dot_l, 1.0), 1.0, alpha) * n_dot_l * row_weight;
                sum += share * texelFetch(u_environment, ivec2(x, y), u_level).rgb;
                weight += share;
            }
        }
    }
    // Divided by what a white environment sums to, so that white stays white to the last bit.
    out_radiance = vec4(sum / weight, 1.0);
}
