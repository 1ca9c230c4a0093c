// Facets whose slopes are wider along one direction of the surface. Source: KHR_materials_anisotropy.

#include "lighting/view.glsl"
#include "material/surface.glsl"
#include "optics/microfacet.glsl"
#ifdef HAS_IMAGE_LIGHT
#include "lighting/environment.glsl"
#endif

// D·V, with light and half vector on the viewer's side.
float anisotropic_facets(Surface s, View w, vec3 l, vec3 h, float n_dot_l) {
    vec3 t = w.tangent, b = cross(w.n, w.tangent);
    vec2 alphas = anisotropic_alphas(s.alpha_roughness, s.anisotropy_strength);
    return d_ggx_anisotropic(dot(t, h), dot(b, h), alphas.x, alphas.y) *
           v_smith_ggx_anisotropic(n_dot_l, w.n_dot_v, dot(t, l), dot(b, l), dot(t, w.v), dot(b, w.v), alphas.x,
                                   alphas.y);
}

#ifdef HAS_IMAGE_LIGHT
const int SLOPE_TAPS = 16;

vec3 anisotropic_radiance(Surface s, View w, vec3 mirrored, float spread_rad) {
    vec2 alphas = anisotropic_alphas(s.alpha_roughness, s.anisotropy_strength);
    vec3 sum = vec3(0.0);
    float weight = 0.0;
    for (int i = 0; i < SLOPE_TAPS; ++i) {
        float place = 2.0 * (float(i) + 0.5) / float(SLOPE_TAPS) - 1.0;
        float x = place * inversesqrt(1.0 - sq(place));
        float slope = alphas.x * x;
        vec3 h = normalize(w.n + slope * w.tangent);
        float v_dot_h = dot(w.v, h);
        vec3 l = reflect(-w.v, h);
        float n_dot_l = dot(w.n, l);
        if (v_dot_h > 0.0 && n_dot_l > 0.0) {
            float stretch = inversesqrt(1.0 + sq(slope));
            float across = alphas.y * sqrt(1.0 + sq(x)) * stretch;
            float step_width = alphas.x * (2.0 / float(SLOPE_TAPS)) * pow(1.0 - sq(place), -1.5) * sq(stretch);
            float alpha = min(max(across, 0.5 * step_width), 1.0);
            float share = n_dot_l;
            sum += share * environment_radiance(l, sqrt(alpha), spread_rad);
            weight += share;
        }
    }
    return weight > 0.0 ? sum / weight : environment_radiance(mirrored, s.perceptual_roughness, spread_rad);
}
#endif
