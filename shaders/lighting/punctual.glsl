// Point, spot and directional lights. Source: KHR_lights_punctual.

#include "common/math.glsl"
#include "generated/constants.glsl"

uniform sampler2D u_lights;  // one row a light, four texels each: gltf_iri/rendering/punctual_lights.py
uniform int u_light_count;

struct Illuminant {
    vec3 direction;    // L, from the surface to the light
    vec3 illuminance;  // on a surface that faces the light
};

// clamp(1 − (d/r)⁴, 0, 1) / d²; range 0 stands for none.
float range_attenuation(float distance_m, float range_m) {
    float window = range_m > 0.0 ? clamp(1.0 - sq(sq(distance_m / range_m)), 0.0, 1.0) : 1.0;
    return window / sq(distance_m);
}

// clamp((cosθ − cos outer) / (cos inner − cos outer), 0, 1)², as a scale and an offset of cosθ.
float spot_attenuation(float cos_theta, vec2 cone) { return sq(clamp(cos_theta * cone.x + cone.y, 0.0, 1.0)); }

Illuminant punctual_light(int index, vec3 position) {
    vec4 place = texelFetch(u_lights, ivec2(0, index), 0);  // world position; w = 0 for a directional light
    vec4 beam = texelFetch(u_lights, ivec2(1, index), 0);   // the way the light travels; range
    vec3 power = texelFetch(u_lights, ivec2(2, index), 0).rgb;
    vec2 cone = texelFetch(u_lights, ivec2(3, index), 0).xy;
    if (place.w == 0.0) {
        return Illuminant(-beam.xyz, power);
    }
    vec3 towards = place.xyz - position;
    float distance_m = max(length(towards), LIGHT_DISTANCE_MIN_M);
    vec3 direction = towards / distance_m;
    float share = range_attenuation(distance_m, beam.w) * spot_attenuation(dot(beam.xyz, -direction), cone);
    return Illuminant(direction, power * share);
}
