// Light of points and suns on the surface, below any coat.

#include "lighting/punctual.glsl"
#include "lighting/view.glsl"
#include "optics/microfacet.glsl"
#ifndef BRAGG_WHOLE
#include "lighting/lobes.glsl"
#endif
#ifdef HAS_ANISOTROPY
#include "lighting/anisotropy.glsl"
#endif
#ifdef HAS_SHEEN
#include "lighting/sheen.glsl"
#endif
#ifdef HAS_BRAGG
#include "lighting/bragg_layers.glsl"
#endif
#ifndef BRAGG_WHOLE

// D·V, with light and half vector on the viewer's side.
float facets(Surface s, View w, vec3 l, vec3 h, float n_dot_l) {
#ifdef HAS_ANISOTROPY
    if (w.tangent != vec3(0.0)) {
        return anisotropic_facets(s, w, l, h, n_dot_l);
    }
#endif
    vec3 n_cross_h = cross(w.n, h);
    return d_ggx(dot(n_cross_h, n_cross_h), s.alpha_roughness) *
           v_smith_ggx_correlated(n_dot_l, w.n_dot_v, s.alpha_roughness);
}

vec3 light_on_base(Surface s, View w, Illuminant light) {
    vec3 l = light.direction;
    float facing = dot(w.n, l);
    bool is_behind = false;
#if defined(HAS_TRANSMISSION) && !defined(HAS_VOLUME)
    // A thin wall bends nothing: light from behind passes facets as if it came mirrored, from the front. Through a
    // body there is none of it, for what bent light of a point draws would be a caustic.
    is_behind = facing < 0.0;
    l = is_behind ? l - 2.0 * facing * w.n : l;
    facing = abs(facing);
#endif
    float n_dot_l = clamp(facing, 0.0, 1.0);
    vec3 halfway = w.v + l;
    // Looking straight into a light there is no half vector, and no facet that could mirror it.
    if (n_dot_l > 0.0 && dot(halfway, halfway) > 0.0) {
        vec3 h = normalize(halfway);
        float v_dot_h = clamp(dot(w.v, h), 0.0, 1.0);
        float lobe = facets(s, w, l, h, n_dot_l);
        vec3 arriving = light.illuminance * n_dot_l;
#ifdef HAS_TRANSMISSION
        WhiteLight through = WhiteLight(vec3(0.0), vec3(0.0), arriving * lobe);
        WhiteLight from_front = WhiteLight(arriving / PI, arriving * lobe, vec3(0.0));
        return mix_lobes(s, facet_lobe(v_dot_h), is_behind ? through : from_front);
#else
        return mix_lobes(s, facet_lobe(v_dot_h), WhiteLight(arriving / PI, arriving * lobe));
#endif
    }
    return vec3(0.0);
}
#endif

vec3 punctual_lighting(Surface s, View w) {
    vec3 sent = vec3(0.0);
    for (int i = 0; i < u_light_count; ++i) {
        Illuminant light = punctual_light(i, v_position);
#ifdef BRAGG_WHOLE
        vec3 base = light_on_layers(s, w, light);
#else
        vec3 base = light_on_base(s, w, light);
#ifdef HAS_BRAGG
        base = mix(base, light_on_layers(s, w, light), s.bragg_factor);
#endif
#endif
#ifdef HAS_SHEEN
        base = sheen_over_punctual(s, w, light, base);
#endif
        sent += base;
    }
    return sent;
}
