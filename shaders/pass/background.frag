// What lies behind the scene: the environment, softly out of focus.

#include "lighting/environment.glsl"

uniform mat3 u_eye_to_world;
uniform vec2 u_half_view;  // tangents of half the view's angles; 0 for parallel rays
uniform float u_blur;      // as a perceptual roughness

in vec2 v_ndc;
out vec4 out_colour;

void main() {
    vec3 direction = normalize(u_eye_to_world * vec3(v_ndc * u_half_view, -1.0));
    out_colour = vec4(environment_radiance(direction, u_blur, 0.0), 0.0);
}
