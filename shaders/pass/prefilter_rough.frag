// The environment as rough facets and as diffuse surfaces send it back: wide lobes, integrated texel by texel over a
// small level. Layers of growing roughness one below the other, and irradiance / π last.
// ∫ L D (N·L) dω / ∫ D (N·L) dω with N = V (Karis 2013, "Real Shading in Unreal Engine 4"); ∫ L (N·L) dω / π, the
// diffuse BRDF of glTF 2.0 Appendix B.2.3.

#include "lighting/equirect.glsl"
#include "optics/microfacet.glsl"

uniform sampler2D u_environment;
uniform int u_level;
uniform ivec2 u_layer_size;
uniform int u_first_layer;
uniform int u_layer_count;  // of all roughnesses, those of prefilter.frag included

out vec4 out_radiance;

void main() {
    int layer = u_first_layer + int(gl_FragCoord.y) / u_layer_size.y;
    bool is_diffuse = layer == u_layer_count;
    float alpha = sq(float(layer + 1) / float(u_layer_count));
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
                // With N = V, H is halfway to L: |N×H|² = (1 − N·L) / 2.
                float facets = is_diffuse ? 1.0 : d_ggx(0.5 - 0.5 * n_dot_l, alpha);
                float share = facets * n_dot_l * row_weight;
                sum += share * texelFetch(u_environment, ivec2(x, y), u_level).rgb;
                weight += share;
            }
        }
    }
    // Divided by what a white environment sums to, so that white stays white to the last bit.
    out_radiance = vec4(sum / weight, 1.0);
}
