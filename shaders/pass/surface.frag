// One surface: gather it, light it, write it.

#include "common/math.glsl"
#include "generated/constants.glsl"
#include "material/normal.glsl"
#include "material/surface.glsl"
#ifndef HAS_UNLIT
#include "lighting/lobes.glsl"
#include "optics/microfacet.glsl"
#ifdef HAS_PUNCTUAL_LIGHTS
#include "lighting/punctual.glsl"
#endif
#ifdef HAS_IMAGE_LIGHT
#include "lighting/environment.glsl"
#endif
#endif

uniform vec4 u_eye;  // perspective: position and 1; orthographic: direction towards the viewer and 0

in vec3 v_position;
centroid in vec3 v_normal;
in vec2 v_uv0;
in vec2 v_uv1;
#ifdef HAS_VERTEX_COLOR
centroid in vec4 v_colour;
#endif
#ifdef HAS_TANGENTS
centroid in vec4 v_tangent;
#endif

#include "pass/surface_outputs.glsl"

vec3 towards_viewer() { return normalize(u_eye.xyz - u_eye.w * v_position); }

vec3 shading_normal() {
    vec3 normal = normalize(v_normal);
#ifdef HAS_NORMAL_TEXTURE
#ifdef HAS_TANGENTS
    mat3 frame = tangent_frame(normal, vec4(normalize(v_tangent.xyz), v_tangent.w));
#else
    mat3 frame = tangent_frame(normal, v_position, normal_uv(v_uv0, v_uv1));
#endif
    normal = mapped_normal(frame, v_uv0, v_uv1);
#endif
    // Only double-sided materials let back faces through the culling.
    return gl_FrontFacing ? normal : -normal;
}

#ifndef HAS_UNLIT
#ifdef HAS_PUNCTUAL_LIGHTS
vec3 punctual_lighting(Surface s, vec3 n, vec3 v, float n_dot_v) {
    vec3 sent = vec3(0.0);
    for (int i = 0; i < u_light_count; ++i) {
        Illuminant light = punctual_light(i, v_position);
        float n_dot_l = clamp(dot(n, light.direction), 0.0, 1.0);
        vec3 halfway = v + light.direction;
        // Looking straight into a light there is no half vector, and no facet that could mirror it.
        if (n_dot_l > 0.0 && dot(halfway, halfway) > 0.0) {
            vec3 h = normalize(halfway);
            float v_dot_h = clamp(dot(v, h), 0.0, 1.0);
            vec3 n_cross_h = cross(n, h);
            float facets = d_ggx(dot(n_cross_h, n_cross_h), s.alpha_roughness) *
                           v_smith_ggx_correlated(n_dot_l, n_dot_v, s.alpha_roughness);
            vec3 arriving = light.illuminance * n_dot_l;
            sent += mix_lobes(s, facet_lobe(v_dot_h), arriving / PI, arriving * facets);
        }
    }
    return sent;
}
#endif

#ifdef HAS_IMAGE_LIGHT
ImageLight image_light(Surface s, vec3 n, vec3 v, float n_dot_v) {
    vec3 mirrored = reflect(-v, n);
    float spread_rad = max(length(dFdx(mirrored)), length(dFdy(mirrored)));
    return ImageLight(
        environment_radiance(mirrored, s.perceptual_roughness, spread_rad) * s.occlusion,
        environment_irradiance(n) * s.occlusion,
        dfg_terms(u_dfg, n_dot_v, s.perceptual_roughness));
}
#endif
#endif

void main() {
    vec4 vertex_colour = vec4(1.0);
#ifdef HAS_VERTEX_COLOR
    vertex_colour = v_colour;
#endif
    Surface s = gather_surface(v_uv0, v_uv1, vertex_colour);
    vec3 n = shading_normal();
    ImageLight image = ImageLight(vec3(0.0), vec3(0.0), vec2(0.0));

#ifdef HAS_UNLIT
    vec3 colour = s.base_color;
#else
    vec3 v = towards_viewer();
    // The lower clamp keeps the masking finite past the silhouette, the upper takes back a unit vector's rounding.
    float n_dot_v = clamp(dot(n, v), N_DOT_V_MIN, 1.0);
    vec3 colour = s.emission;
#ifdef HAS_PUNCTUAL_LIGHTS
    colour += punctual_lighting(s, n, v, n_dot_v);
#endif
#ifdef HAS_IMAGE_LIGHT
    image = image_light(s, n, v, n_dot_v);
    Lobe lobe = Lobe(n_dot_v, image.dfg.x, image.dfg.y);
    colour += mix_lobes(s, lobe, image.irradiance, image.radiance);
#endif
#endif

    write_surface(s, n, image, colour);

#ifdef HAS_ALPHA_MASK
    // Last, so that every derivative above is defined.
    if (s.alpha < u_alpha_cutoff) {
        discard;
    }
#endif
}
