// Rough layers of Bragg mirrors in place of the base's interface, under light from one direction.
// Twin: `brdf` of gltf_iri/evaluation/layers.py. Fourneau et al. 2024, "Interactive Exploration of Vivid Material
// Iridescence using Bragg Mirrors", Eq. 34: each path is mirrored once, by a layer or below them all, and passes those
// above it unbent.

#include "lighting/layer_colours.glsl"
#if defined(BRAGG_BASE) && defined(HAS_DIELECTRIC)
#include "lighting/bragg_through.glsl"
#endif
#include "lighting/punctual.glsl"
#include "lighting/view.glsl"
#include "material/surface.glsl"
#include "optics/fresnel.glsl"
#include "optics/layer_stack.glsl"
#include "optics/microfacet.glsl"
#include "optics/rough_bragg.glsl"

// As `sight_of` by vectors: what light and viewer differ by across the normal keeps its digits, so that the narrow
// lobe of a smooth layer does.
Sight sight_between(View w, vec3 l, float n_dot_l) {
    float cos_i = cosine_in_host(u_bragg_host_ior, n_dot_l);
    float cos_o = cosine_in_host(u_bragg_host_ior, w.n_dot_v);
    vec3 both = l + w.v;
    vec3 across = (both - w.n * dot(w.n, both)) / u_bragg_host_ior;
    float across_squared = dot(across, across);
    float total = across_squared + sq(cos_i + cos_o);  // |i + o|², i and o in the host
    float passage = 1.0;
#ifdef BRAGG_COATING
    passage = coating_transmittance(u_bragg_host_ior, n_dot_l) * coating_transmittance(u_bragg_host_ior, w.n_dot_v) /
              sq(u_bragg_host_ior);
#endif
    return Sight(cos_i, cos_o, min(0.5 * sqrt(total), 1.0), across_squared / total, passage);
}

#ifdef BRAGG_BASE
// The base below all layers: what the dielectric scatters, and the metal.
vec3 sent_by_base(Surface s, Sight seen) {
    vec3 sent = vec3(0.0);
#ifdef HAS_DIELECTRIC
    sent += scattered_by_base(s) / PI;
#endif
#ifdef HAS_METAL
    float weight = facet_weight(seen.n_cross_h_squared, seen.cos_i, seen.cos_o, s.alpha_roughness);
    sent += s.metallic * weight * f_schlick(s.base_color, seen.cos_h);
#endif
    return sent;
}
#endif

#ifdef BRAGG_COATING
// What the smooth surface of the host mirrors, as a clear coat without roughness does.
float mirrored_by_coating(View w, vec3 l, float n_dot_l) {
    vec3 h = normalize(w.v + l);
    vec3 n_cross_h = cross(w.n, h);
    float mirrored = 1.0 - coating_transmittance(u_bragg_host_ior, clamp(dot(w.v, h), 0.0, 1.0));
    return mirrored * d_ggx(dot(n_cross_h, n_cross_h), ALPHA_MIN) *
           v_smith_ggx_correlated(n_dot_l, w.n_dot_v, ALPHA_MIN);
}
#endif

vec3 light_on_layers(Surface s, View w, Illuminant light) {
    float n_dot_l = clamp(dot(w.n, light.direction), 0.0, 1.0);
    vec3 halfway = w.v + light.direction;
    if (n_dot_l > 0.0 && dot(halfway, halfway) > 0.0) {
        Sight seen = sight_between(w, light.direction, n_dot_l);
        vec3 sent = vec3(0.0);
        for (int i = 0; i < BRAGG_LAYERS; ++i) {
            sent += facet_weight(seen.n_cross_h_squared, seen.cos_i, seen.cos_o, u_bragg_alpha[i]) *
                    layer_reflected(s, i, seen.cos_h, seen.cos_i, seen.cos_o);
        }
#ifdef BRAGG_BASE
        sent += layers_passed(s, seen.cos_i, seen.cos_o) * sent_by_base(s, seen);
#endif
#ifdef BRAGG_COATING
        sent = seen.passage * sent + mirrored_by_coating(w, light.direction, n_dot_l);
#endif
        return sent * light.illuminance * n_dot_l;
    }
#if defined(BRAGG_BASE) && defined(HAS_TRANSMISSION) && !defined(HAS_VOLUME)
    return light_from_behind(s, w, light);
#else
    return vec3(0.0);
#endif
}
