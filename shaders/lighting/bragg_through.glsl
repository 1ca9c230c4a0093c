// What lies below Bragg layers and is no metal: a share of the light scatters back, the rest comes from behind.
// Sources: EXT_materials_bragg; KHR_materials_transmission. The layers stand in place of the base's interface, which
// neither mirrors nor holds back anything here.

#include "lighting/layer_colours.glsl"
#include "material/surface.glsl"
#ifdef HAS_PUNCTUAL_LIGHTS
#include "lighting/punctual.glsl"
#include "lighting/view.glsl"
#include "optics/microfacet.glsl"
#endif

// What the base scatters of the light that reaches it, by its albedo.
vec3 scattered_by_base(Surface s) {
    vec3 scattered = (1.0 - s.metallic) * s.base_color * u_bragg_bent;
#ifdef HAS_TRANSMISSION
    scattered *= 1.0 - s.transmission;
#endif
    return scattered;
}

#ifdef HAS_TRANSMISSION
// What of light from behind reaches the host's surface: it crosses every layer once, on its way to the viewer.
vec3 passed_from_behind(Surface s, View w) {
    return (1.0 - s.metallic) * s.transmission * s.base_color * layers_entering(s, cosine_at_layers(w));
}

#if defined(HAS_PUNCTUAL_LIGHTS) && !defined(HAS_VOLUME)
// Through a thin wall, which bends nothing: its facets see light from behind as if it came mirrored, from the front.
vec3 light_from_behind(Surface s, View w, Illuminant light) {
    float facing = dot(w.n, light.direction);
    vec3 l = light.direction - 2.0 * facing * w.n;
    float n_dot_l = clamp(-facing, 0.0, 1.0);
    vec3 halfway = w.v + l;
    // Looking straight into a light that grazes there is no half vector.
    if (n_dot_l > 0.0 && dot(halfway, halfway) > 0.0) {
        vec3 n_cross_h = cross(w.n, normalize(halfway));
        float lobe = d_ggx(dot(n_cross_h, n_cross_h), s.alpha_roughness) *
                     v_smith_ggx_correlated(n_dot_l, w.n_dot_v, s.alpha_roughness);
        return coating_transmittance(u_bragg_host_ior, w.n_dot_v) * passed_from_behind(s, w) *
               (lobe * n_dot_l * light.illuminance);
    }
    return vec3(0.0);
}
#endif
#endif
