// Vertices into the world and onto the picture.

uniform mat4 u_world;
uniform mat3 u_normal_matrix;  // cofactors of u_world: right for uneven and negative scales, and never singular
uniform mat4 u_view_projection;

in vec3 in_position;
in vec3 in_normal;
in vec2 in_uv0;
in vec2 in_uv1;
#ifdef HAS_VERTEX_COLOR
in vec4 in_colour;
centroid out vec4 v_colour;
#endif
#ifdef HAS_TANGENTS
uniform float u_handedness;  // −1 where the world matrix mirrors
in vec4 in_tangent;
centroid out vec4 v_tangent;
#endif

out vec3 v_position;
centroid out vec3 v_normal;  // at an edge, the pixel's centre may lie where normals turn away
out vec2 v_uv0;
out vec2 v_uv1;

void main() {
    vec4 position = u_world * vec4(in_position, 1.0);
    v_position = position.xyz;
    v_normal = u_normal_matrix * in_normal;
    v_uv0 = in_uv0;
    v_uv1 = in_uv1;
#ifdef HAS_VERTEX_COLOR
    v_colour = in_colour;
#endif
#ifdef HAS_TANGENTS
    v_tangent = vec4(mat3(u_world) * in_tangent.xyz, in_tangent.w * u_handedness);
#endif
    gl_Position = u_view_projection * position;
}
