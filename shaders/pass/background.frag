// What lies behind the scene: a colour, or the environment softly out of focus. It covers nothing.

#include "lighting/environment.glsl"

uniform mat3 u_eye_to_world;
uniform vec2 u_half_view;  // tangents of half the view's angles; 0 for parallel rays
uniform float u_background_blur;  // as a perceptual roughness
uniform vec4 u_backdrop;          // w = 0: the environment

in vec2 v_ndc;
out vec4 out_colour;

void main() {
    vec3 direction = normalize(u_eye_to_world * vec3(v_ndc * u_half_view, -1.0));
    vec3 light = u_backdrop.w > 0.0 ? u_backdrop.rgb : environment_radiance(direction, u_background_blur, 0.0);
    out_colour = vec4(light, 0.0);
}
