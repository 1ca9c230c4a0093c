// One surface: gather it, light it, write it.

#include "common/math.glsl"
#include "generated/constants.glsl"
#include "material/normal.glsl"
#include "material/surface.glsl"

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

#include "lighting/view.glsl"
#include "pass/surface_outputs.glsl"
#ifndef HAS_UNLIT
#include "lighting/indirect.glsl"
#ifdef HAS_PUNCTUAL_LIGHTS
#include "lighting/direct.glsl"
#endif
#ifdef HAS_SHEEN
#include "lighting/sheen.glsl"
#endif
#ifdef HAS_CLEARCOAT
#include "lighting/clearcoat.glsl"
#endif
#endif

vec3 towards_viewer() { return normalize(u_eye.xyz - u_eye.w * v_position); }

#if defined(HAS_NORMAL_TEXTURE) || defined(HAS_ANISOTROPY) || defined(HAS_CLEARCOAT_NORMAL_TEXTURE)
#ifdef HAS_TANGENTS
#define FRAME(normal, uv) tangent_frame(normal, vec4(normalize(v_tangent.xyz), v_tangent.w))
#else
#define FRAME(normal, uv) tangent_frame(normal, v_position, uv)
#endif
#endif

View view_surface(Surface s) {
    View w;
    vec3 front = normalize(v_normal);
    vec3 normal = front;
#ifdef HAS_NORMAL_TEXTURE
    normal = mapped_normal(FRAME(front, normal_uv(v_uv0, v_uv1)), v_uv0, v_uv1);
#endif
    // Only double-sided materials let back faces through the culling.
    w.n = gl_FrontFacing ? normal : -normal;
    w.v = towards_viewer();
    // The lower clamp keeps the masking finite past the silhouette, the upper takes back a unit vector's rounding.
    w.n_dot_v = clamp(dot(w.n, w.v), N_DOT_V_MIN, 1.0);
#ifdef HAS_ANISOTROPY
#ifdef HAS_ANISOTROPY_TEXTURE
    w.tangent = tangent_along(FRAME(front, anisotropy_uv(v_uv0, v_uv1)), s.anisotropy_direction, w.n);
#else
    w.tangent = tangent_along(FRAME(front, v_uv0), s.anisotropy_direction, w.n);
#endif
#endif
#ifdef HAS_CLEARCOAT
    vec3 coat = front;
#ifdef HAS_CLEARCOAT_NORMAL_TEXTURE
    coat = mapped_clearcoat_normal(FRAME(front, clearcoat_normal_uv(v_uv0, v_uv1)), v_uv0, v_uv1);
#endif
    w.coat_n = gl_FrontFacing ? coat : -coat;
    w.coat_n_dot_v = clamp(dot(w.coat_n, w.v), N_DOT_V_MIN, 1.0);
#endif
    return w;
}

void main() {
    vec4 vertex_colour = vec4(1.0);
#ifdef HAS_VERTEX_COLOR
    vertex_colour = v_colour;
#endif
    Surface s = gather_surface(v_uv0, v_uv1, vertex_colour);
    View w = view_surface(s);

#ifdef HAS_UNLIT
    ImageLight image = no_image_light();
    vec3 colour = s.base_color;
#else
    vec3 colour = s.emission;
#ifdef HAS_PUNCTUAL_LIGHTS
    colour += punctual_lighting(s, w);
#endif
    ImageLight image = image_light(s, w);
#if defined(HAS_IMAGE_LIGHT) || defined(HAS_TRANSMISSION)
    colour += image_lighting(s, w, image);
#endif
#ifdef HAS_CLEARCOAT
    colour *= 1.0 - clearcoat_reflectance(s, image.clearcoat_dfg);
    colour += clearcoat_lighting(s, w, image);
#endif
#endif

    write_surface(s, w, image, colour);

#ifdef HAS_ALPHA_MASK
    // Last, so that every derivative above is defined.
    if (s.alpha < u_alpha_cutoff) {
        discard;
    }
#endif
}
