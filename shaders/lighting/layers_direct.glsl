// The colours of Bragg layers from their films, at each point anew: the truth of the model, and slow.
// Image light asks once a layer, as films do: at the mean cosine of the facets that send it, and what comes from below
// passes inwards at the mean cosine of light from all around, 2/3.

#include "common/math.glsl"
#include "lighting/dfg.glsl"
#include "material/surface.glsl"
#include "optics/layers_single.glsl"

uniform vec4 u_bragg_films[BRAGG_LAYERS];    // n1, n2, share of the first in a cell, cells
uniform vec2 u_bragg_periods_nm[BRAGG_LAYERS];  // at u_bragg_texel_low, and what one more adds
uniform float u_bragg_texel_low;

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
#endif

#ifdef HAS_IMAGE_LIGHT
vec3 layer_albedo(Surface s, int layer, float cos_o) {
    vec3 dfg = dfg_facets(u_dfg, cos_o, sqrt(u_bragg_alpha[layer]));
    return (dfg.x + dfg.y) * layer_reflected(s, layer, dfg.z, cos_o, cos_o);
}

#ifdef BRAGG_BASE
vec3 layers_passed_irradiance(Surface s, float cos_o) {
    return layers_passed(s, cosine_in_host(u_bragg_host_ior, 2.0 / 3.0), cos_o);
}
#endif
#endif
