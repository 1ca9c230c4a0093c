// The environment as smooth facets mirror it: one layer a roughness, layers one below the other.
// Karis 2013, "Real Shading in Unreal Engine 4" (N = V = R, weights N·L); Křivánek & Colbert 2008, "Real-time Shading
// with Filtered Importance Sampling" (each sample reads the level whose texels are as large as its share of the lobe).

#include "lighting/equirect.glsl"

uniform sampler2D u_environment;  // with solid-angle weighted levels
uniform sampler2D u_samples;      // one row a layer: direction about +Z, steradians to average over
uniform ivec2 u_layer_size;

out vec4 out_radiance;

void main() {
    int layer = int(gl_FragCoord.y) / u_layer_size.y;
    vec3 normal = direction_of_texel(gl_FragCoord.xy, vec2(u_layer_size));
    float azimuth = gl_FragCoord.x / float(u_layer_size.x) * 2.0 * PI;
    vec3 tangent = vec3(sin(azimuth), 0.0, -cos(azimuth));  // eastwards, at the poles too
    mat3 frame = mat3(tangent, cross(normal, tangent), normal);
    vec2 size = vec2(textureSize(u_environment, 0));
    float texel_solid_angle = 2.0 * sq(PI) / (size.x * size.y);  // on the equator

    vec3 sum = vec3(0.0);
    float weight = 0.0;
    for (int i = 0; i < textureSize(u_samples, 0).x; ++i) {
        vec4 ray = texelFetch(u_samples, ivec2(i, layer), 0);
        if (ray.z > 0.0) {
            vec3 direction = frame * ray.xyz;
            // Towards the poles texels shrink; the floor keeps the level finite where they vanish.
            float shrink = max(length(direction.xz), 1.0 / size.y);
            float level = max(0.5 * log2(ray.w / texel_solid_angle), 0.0);
            sum += ray.z * textureLod(u_environment, equirect_from_direction(direction), level).rgb;
            weight += ray.z;
        }
    }
    out_radiance = vec4(sum / weight, 1.0);
}
