// Depth along the view's axis, in metres, from the depth buffer: depth · known and known, so that levels of both
// average over what is known alone. What wrote no depth is unknown.

uniform sampler2D u_depth;
uniform vec2 u_depth_scale;  // third row of the projection: clip z = −scale.x · depth + scale.y
uniform bool u_is_perspective;

out vec2 out_depth_known;

void main() {
    float stored = texelFetch(u_depth, ivec2(gl_FragCoord.xy), 0).r;
    float z = 2.0 * stored - 1.0;
    float along = u_is_perspective ? u_depth_scale.y / (z + u_depth_scale.x) : (u_depth_scale.y - z) / u_depth_scale.x;
    out_depth_known = stored < 1.0 ? vec2(along, 1.0) : vec2(0.0);
}
