// Directions in the surface, and normals that a map bends. Sources: glTF 2.0 §3.7.2.1, §3.9.3; KHR_materials_anisotropy;
// KHR_materials_clearcoat.

#include "generated/material.glsl"

#if defined(HAS_NORMAL_TEXTURE) || defined(HAS_ANISOTROPY) || defined(HAS_CLEARCOAT_NORMAL_TEXTURE)
#ifdef HAS_TANGENTS
// Columns tangent, bitangent, normal; the handedness says which way the bitangent points.
mat3 tangent_frame(vec3 normal, vec4 tangent) {
    return mat3(tangent.xyz, cross(normal, tangent.xyz) * tangent.w, normal);
}
#else
// The same from how position and texture coordinates change across the picture: ∂P/∂u, made upright on the normal,
// and −∂P/∂v, for glTF's v points down and the map's green up. Mirrored coordinates turn only the bitangent.
mat3 tangent_frame(vec3 normal, vec3 position, vec2 uv) {
    vec3 px = dFdx(position), py = dFdy(position);
    vec2 ux = dFdx(uv), uy = dFdy(uv);
    float area = ux.x * uy.y - uy.x * ux.y;
    vec3 along_u = (px * uy.y - py * ux.y) * sign(area);
    vec3 along_v = (py * ux.x - px * uy.x) * sign(area);
    vec3 tangent = along_u - normal * dot(normal, along_u);
    float size = length(tangent);
    if (size == 0.0) {
        return mat3(vec3(0.0), vec3(0.0), normal);  // no texture coordinates: no bumps and no directions
    }
    tangent /= size;
    vec3 bitangent = cross(normal, tangent);
    return mat3(tangent, dot(bitangent, along_v) > 0.0 ? -bitangent : bitangent, normal);
}
#endif
#endif

#ifdef HAS_NORMAL_TEXTURE
vec3 mapped_normal(mat3 frame, vec2 uv0, vec2 uv1) {
    vec3 bump = sample_normal(uv0, uv1) * 2.0 - 1.0;
    return normalize(frame * (bump * vec3(u_normal_scale, u_normal_scale, 1.0)));
}
#endif

#ifdef HAS_CLEARCOAT_NORMAL_TEXTURE
vec3 mapped_clearcoat_normal(mat3 frame, vec2 uv0, vec2 uv1) {
    vec3 bump = sample_clearcoat_normal(uv0, uv1) * 2.0 - 1.0;
    return normalize(frame * (bump * vec3(u_clearcoat_normal_scale, u_clearcoat_normal_scale, 1.0)));
}
#endif

#ifdef HAS_ANISOTROPY
// The direction of the frame that (x, y) names, laid upright against n; 0 where the frame has none.
vec3 tangent_along(mat3 frame, vec2 direction, vec3 n) {
    vec3 tangent = frame[0] * direction.x + frame[1] * direction.y;
    tangent -= n * dot(n, tangent);
    float size = length(tangent);
    return size > 0.0 ? tangent / size : vec3(0.0);
}
#endif
