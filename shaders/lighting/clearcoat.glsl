// A clear varnish of index 1.5 over everything, emission included. Source: KHR_materials_clearcoat.
// A film lies below it and keeps air as its outside: KHR_materials_iridescence ignores the coat's interface.

#include "generated/constants.glsl"
#include "generated/layer_constants.glsl"
#include "lighting/view.glsl"
#include "material/surface.glsl"
#include "optics/fresnel.glsl"
#include "optics/microfacet.glsl"
#include "pass/surface_outputs.glsl"
#ifdef HAS_PUNCTUAL_LIGHTS
#include "lighting/punctual.glsl"
#endif

// Share of the light from all around that the coat sends to the viewer; the rest is what is seen below it.
float clearcoat_reflectance(Surface s, vec2 dfg) { return s.clearcoat * (CLEARCOAT_F0 * dfg.x + dfg.y); }

#ifdef HAS_PUNCTUAL_LIGHTS
vec3 punctual_clearcoat(Surface s, View w) {
    vec3 sent = vec3(0.0);
    float alpha = alpha_ggx(s.clearcoat_roughness);
    for (int i = 0; i < u_light_count; ++i) {
        Illuminant light = punctual_light(i, v_position);
        float n_dot_l = clamp(dot(w.coat_n, light.direction), 0.0, 1.0);
        vec3 halfway = w.v + light.direction;
        if (n_dot_l > 0.0 && dot(halfway, halfway) > 0.0) {
            vec3 h = normalize(halfway);
            vec3 n_cross_h = cross(w.coat_n, h);
            float fresnel = f_schlick(CLEARCOAT_F0, clamp(dot(w.v, h), 0.0, 1.0));
            sent += light.illuminance * (n_dot_l * fresnel * d_ggx(dot(n_cross_h, n_cross_h), alpha) *
                                         v_smith_ggx_correlated(n_dot_l, w.coat_n_dot_v, alpha));
        }
    }
    return s.clearcoat * sent;
}
#endif

// What the coat itself sends to the viewer.
vec3 clearcoat_lighting(Surface s, View w, ImageLight image) {
    vec3 sent = clearcoat_reflectance(s, image.clearcoat_dfg) * image.clearcoat_radiance;
#ifdef HAS_PUNCTUAL_LIGHTS
    sent += punctual_clearcoat(s, w);
#endif
    return sent;
}
