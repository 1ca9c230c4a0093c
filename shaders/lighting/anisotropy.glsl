// Facets whose slopes are wider along one direction of the surface. Source: KHR_materials_anisotropy.
// What image light costs in accuracy: spec/renderer-notes.md, Anisotropy.

#include "lighting/dfg.glsl"
#include "lighting/view.glsl"
#include "material/surface.glsl"
#include "optics/anisotropic_microfacet.glsl"
#ifdef HAS_IMAGE_LIGHT
#include "lighting/environment.glsl"
#endif

// Components along the direction, across it and along the normal.
vec3 in_surface(View w, vec3 direction) {
    return vec3(dot(w.tangent, direction), dot(cross(w.n, w.tangent), direction), dot(w.n, direction));
}

// D·V, with light and half vector on the viewer's side.
float anisotropic_facets(Surface s, View w, vec3 l, vec3 h, float n_dot_l) {
    vec2 alphas = anisotropic_alphas(s.alpha_roughness, s.anisotropy_strength);
    vec3 light = in_surface(w, l), view = in_surface(w, w.v), facet = in_surface(w, h);
    return d_ggx_anisotropic(facet.x, facet.y, alphas.x, alphas.y) *
           v_smith_ggx_anisotropic(n_dot_l, w.n_dot_v, light.x, light.y, view.x, view.y, alphas.x, alphas.y);
}

// (A, B) of facets with one roughness that send as much: for B, what is seen at grazing angles, the roughness along
// the view; for A + B, what is not masked, more of the roughness across it. Fitted to the integral over all light:
// off by 0.02 on average, where the roughness across the stretch alone would be off by 0.14.
// The mean cosine is that of the former.
vec3 anisotropic_dfg_facets(Surface s, View w) {
    if (w.tangent == vec3(0.0)) {
        return dfg_facets(u_dfg, w.n_dot_v, s.perceptual_roughness);
    }
    vec2 alphas = anisotropic_alphas(s.alpha_roughness, s.anisotropy_strength);
    vec3 view = in_surface(w, w.v);
    float mean = 0.5 * (sq(alphas.x) + sq(alphas.y));
    float difference = 0.5 * (sq(alphas.x) - sq(alphas.y)) * (sq(view.x) - sq(view.y));
    // α² is the fourth power of what the table asks for. A normal that leans from the viewer may round below 0.
    vec3 whole = dfg_facets(u_dfg, w.n_dot_v, sqrt(sqrt(mean - 0.5 * difference)));
    vec2 grazing = dfg_terms(u_dfg, w.n_dot_v, sqrt(sqrt(max(mean + difference, 0.0))));
    return vec3(max(whole.x + whole.y - grazing.y, 0.0), grazing.y, whole.z);
}

#ifdef HAS_IMAGE_LIGHT
const float TAPS_MIN = 8.0, TAPS_MAX = 24.0;
const float TAPS_PER_STRETCH = 4.0;  // times α along the direction over α across it: more would only overlap more
const float SECTION_WIDTH = 0.7;     // of the round lobe that stands for a section of the stretched one
const float TAP_SHARE = 0.42;        // of the step between taps, below which bright light would show as rows of images

// Radiance of the environment without its lamps that the stretched lobe collects: facets at even shares of the slopes
// along the direction, each with a round lobe as wide as the slopes across. Slopes x of facets of roughness 1 lie below
// x with probability ½ + ½ x/√(1 + x²), and at x the slopes across are √(1 + x²) times as wide as at 0. A facet sends
// 4 V (N·L)(V·H)/(N·H) of the light that it mirrors. As with round facets what is collected lies nearer the normal, but
// only across the direction: along it, the sum over facets already leaves out what is masked.
vec3 stretched_rest_radiance(View w, vec2 alphas, vec3 mirrored, float spread_rad) {
    vec3 view = in_surface(w, w.v);
    float taps = clamp(ceil(TAPS_PER_STRETCH * alphas.x / alphas.y), TAPS_MIN, TAPS_MAX);
    float share_across = mirror_share(alphas.y);
    vec3 sum = vec3(0.0);
    float weight = 0.0;
    for (float i = 0.5; i < taps; ++i) {
        float place = 2.0 * i / taps - 1.0;             // x/√(1 + x²)
        float widening = inversesqrt(1.0 - sq(place));  // √(1 + x²)
        float slope = alphas.x * place * widening;
        float n_dot_h = inversesqrt(1.0 + sq(slope));
        vec3 h = (w.n + slope * w.tangent) * n_dot_h;
        float v_dot_h = dot(w.v, h);
        vec3 l = reflect(-w.v, h);
        vec3 light = in_surface(w, l);
        if (v_dot_h > 0.0 && light.z > 0.0) {
            float across = alphas.y * widening * n_dot_h;
            float step_rad = alphas.x * widening * sq(widening * n_dot_h) * 2.0 / taps;
            float alpha = min(max(SECTION_WIDTH * across, TAP_SHARE * step_rad), 1.0);
            float visibility = v_smith_ggx_anisotropic(light.z, w.n_dot_v, light.x, light.y, view.x, view.y,
                                                       alphas.x, alphas.y);
            float share = visibility * light.z * v_dot_h / n_dot_h;
            vec3 middle = normalize(mix(w.n + light.x * w.tangent, l, share_across));
            sum += share * rest_radiance(equirect_from_direction(middle), sqrt(alpha), spread_rad);
            weight += share;
        }
    }
    // Past the silhouette no facet may mirror anything from above the surface.
    return weight > 0.0 ? sum / weight
                        : rest_radiance(equirect_from_direction(mirrored), sqrt(alphas.y), spread_rad);
}

// The whole: with the lamps, once, through the stretched facets themselves. `albedo` is A + B.
vec3 anisotropic_radiance(Surface s, View w, vec3 mirrored, float albedo, float spread_rad) {
    if (w.tangent == vec3(0.0)) {
        return mirrored_radiance(mirrored, w.n, w.v, s.perceptual_roughness, albedo, spread_rad);
    }
    vec2 alphas = anisotropic_alphas(s.alpha_roughness, s.anisotropy_strength);
    LampLobe lobe = LampLobe(mirrored, alphas.y, spread_rad, w.n, w.v, albedo, vec4(w.tangent, alphas.x));
    return stretched_rest_radiance(w, alphas, mirrored, spread_rad) +
           lamp_radiance(equirect_from_direction(mirrored), lobe);
}
#endif
