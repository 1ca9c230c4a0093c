// The colours of Bragg layers from their films, at each point anew: the truth of the model, and slow.
// Image light asks once a layer, as films do: at the mean cosine of the facets that send it, and what comes from below
// passes inwards at the mean cosine of light from all around, 2/3.

#include "common/math.glsl"
#include "lighting/dfg.glsl"
#include "lighting/view.glsl"
#include "material/surface.glsl"
#include "optics/layer_stack.glsl"
#include "optics/layers_single.glsl"

uniform vec4 u_bragg_films[BRAGG_LAYERS];    // n1, n2, share of the first in a cell, cells
uniform vec2 u_bragg_periods_nm[BRAGG_LAYERS];  // at u_bragg_texel_low, and what one more adds
uniform float u_bragg_texel_low;
#if defined(BRAGG_BASE) && defined(HAS_IMAGE_LIGHT)
uniform float u_bragg_coating_irradiance;  // of a white sky, in the host
#endif

void stack_of(Surface s, out BraggLayer stack[BRAGG_LAYERS_MAX]) {
    for (int i = 0; i < BRAGG_LAYERS; ++i) {
        vec4 films = u_bragg_films[i];
        vec2 period_nm = u_bragg_periods_nm[i];
        float nm = period_nm.x + period_nm.y * (s.bragg_period_texel - u_bragg_texel_low);
        stack[i] = BraggLayer(films.x, films.y, films.z * nm, (1.0 - films.z) * nm, films.w, u_bragg_alpha[i]);
    }
}

vec3 layer_reflected(Surface s, int layer, float cos_h, float cos_i, float cos_o) {
    BraggLayer stack[BRAGG_LAYERS_MAX];
    stack_of(s, stack);
    return stack_reflected(u_bragg_host_ior, stack, layer, cos_h, cos_i, cos_o);
}

#ifdef BRAGG_BASE
vec3 layers_passed(Surface s, float cos_i, float cos_o) {
    BraggLayer stack[BRAGG_LAYERS_MAX];
    stack_of(s, stack);
    return stack_passed(u_bragg_host_ior, stack, BRAGG_LAYERS, cos_i, cos_o);
}

#ifdef HAS_TRANSMISSION
vec3 layers_entering(Surface s, float cos_o) {
    BraggLayer stack[BRAGG_LAYERS_MAX];
    stack_of(s, stack);
    return stack_entering(u_bragg_host_ior, stack, BRAGG_LAYERS, cos_o);
}
#endif
#endif

#ifdef HAS_IMAGE_LIGHT
vec3 layer_albedo(Surface s, View w, int layer) {
    float cos_o = cosine_at_layers(w);
    vec3 dfg = dfg_facets(u_dfg, cos_o, sqrt(u_bragg_alpha[layer]));
    return coating_transmittance(u_bragg_host_ior, w.n_dot_v) * (dfg.x + dfg.y) *
           layer_reflected(s, layer, dfg.z, cos_o, cos_o);
}

#ifdef BRAGG_BASE
vec3 scattered_albedo(Surface s, View w) {
    return u_bragg_coating_irradiance *
           layers_passed(s, cosine_in_host(u_bragg_host_ior, 2.0 / 3.0), cosine_at_layers(w));
}

#ifdef HAS_METAL
vec3 metal_albedo(Surface s, View w) {
    float cos_o = cosine_at_layers(w);
    vec2 dfg = dfg_terms(u_dfg, cos_o, s.perceptual_roughness);
    return coating_transmittance(u_bragg_host_ior, w.n_dot_v) * (s.base_color * dfg.x + dfg.y) *
           layers_passed(s, cos_o, cos_o);
}
#endif
#endif
#endif
