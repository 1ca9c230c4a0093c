// The environment as a lobe sees it: a layer for each row of rays, layers one below the other.
// Karis 2013, "Real Shading in Unreal Engine 4" (N = V = R); Křivánek & Colbert 2008, "Real-time Shading with Filtered
// Importance Sampling" (each ray reads the level whose texels are as large as its share of the lobe).

#include "lighting/equirect.glsl"

uniform sampler2D u_environment;  // with solid-angle weighted levels
uniform sampler2D u_samples;      // direction about +Z, steradians to average over
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

    int count = textureSize(u_samples, 0).x;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < count; ++i) {
        vec4 ray = texelFetch(u_samples, ivec2(i, layer), 0);
        // Towards the poles texels shrink across only: what a ray then misses beside it is less than what it would
        // blur along a meridian in a level that covers its whole share.
        float level = max(0.5 * log2(ray.w / texel_solid_angle), 0.0);
        sum += textureLod(u_environment, equirect_from_direction(frame * ray.xyz), level).rgb;
    }
    out_radiance = vec4(sum / float(count), 1.0);
}
