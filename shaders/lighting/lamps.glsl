// Small, bright lights of the environment, each lit by formula. Made by gltf_iri/rendering/environment_lamps.py.

#include "generated/constants.glsl"
#include "optics/microfacet.glsl"
#ifdef HAS_ANISOTROPY
#include "optics/anisotropic_microfacet.glsl"
#endif

// A column a lamp: (direction, mean squared radius in rad²), (radiance · steradians).
uniform sampler2D u_environment_lamps;

const float LAMP_ALPHA_MAX = 0.995;  // at 1 the norm below is 0/0; the lobe hardly changes in between

// ∫ D (N·L) dω over the directions of light for N = V: 4/b (1 − ln(1 + x)/x), b = 1 − α², x = b/2α².
float lobe_norm(float alpha) {
    float a2 = sq(alpha);
    float b = 1.0 - a2;
    float x = b / (2.0 * a2);
    return 4.0 / b * (1.0 - log(1.0 + x) / x);
}

// How a lamp is looked at: about `direction`, or through the facets of a surface where `albedo` is above 0.
struct LampLobe {
    vec3 direction;
    float alpha;
    float spread_rad;  // between the directions of neighbouring pixels
    vec3 n;
    vec3 v;
    float albedo;      // A + B: ∫ D V (N·L) dω
    vec4 stretch;      // direction in the surface, and α along it; 0: round
};

float widest_alpha(LampLobe lobe) { return max(lobe.alpha, lobe.stretch.w); }

// The share of a small disc of light with the mean squared radius `size_squared`, per steradian: D V (N·L) / (A + B),
// or D (N·L) / ∫ D (N·L) dω for N = V = `direction`.
float disc_lobe(LampLobe lobe, vec3 disc, float size_squared) {
    // About as wide as the convolution of disc and lobe: 0.5 is right at its centre, less further out.
    float widened = min(sqrt(sq(lobe.alpha) + 0.45 * size_squared), LAMP_ALPHA_MAX);
    if (lobe.albedo > 0.0) {
        float n_dot_l = dot(lobe.n, disc);
        vec3 halfway = lobe.v + disc;
        if (n_dot_l <= 0.0 || dot(halfway, halfway) == 0.0) {
            return 0.0;
        }
        vec3 h = normalize(halfway);
        float n_dot_v = clamp(dot(lobe.n, lobe.v), N_DOT_V_MIN, 1.0);
#ifdef HAS_ANISOTROPY
        if (lobe.stretch.w > 0.0) {
            vec3 t = lobe.stretch.xyz, b = cross(lobe.n, t);
            float widened_along = sqrt(sq(lobe.stretch.w) + 0.45 * size_squared);
            return d_ggx_anisotropic(dot(t, h), dot(b, h), widened_along, widened) *
                   v_smith_ggx_anisotropic(n_dot_l, n_dot_v, dot(t, disc), dot(b, disc), dot(t, lobe.v),
                                           dot(b, lobe.v), lobe.stretch.w, lobe.alpha) *
                   n_dot_l / lobe.albedo;
        }
#endif
        vec3 n_cross_h = cross(lobe.n, h);
        return d_ggx(dot(n_cross_h, n_cross_h), widened) *
               v_smith_ggx_correlated(n_dot_l, n_dot_v, lobe.alpha) * n_dot_l / lobe.albedo;
    }
    // With N = V, H is halfway to L: |N×H|² = (1 − N·L) / 2 = |N − L|² / 4, which does not cancel.
    vec3 apart = lobe.direction - disc;
    float apart_squared = dot(apart, apart);
    return d_ggx(0.25 * apart_squared, widened) * max(1.0 - 0.5 * apart_squared, 0.0) / lobe_norm(widened);
}

// The mean over a pixel whose directions lie within a mean squared angle: von Mises and Fisher's distribution, which
// has no tail, and is 1 over the whole sphere also where it is wide.
float disc_in_pixel(vec3 direction, vec3 disc, float size_squared) {
    vec3 apart = direction - disc;
    return exp(-dot(apart, apart) / size_squared) / (PI * size_squared * (1.0 - exp(-4.0 / size_squared)));
}

// What all lamps send into the lobe.
vec3 lamp_lobe_radiance(LampLobe lobe) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < textureSize(u_environment_lamps, 0).x; ++i) {
        vec4 place = texelFetch(u_environment_lamps, ivec2(i, 0), 0);
        float size_squared = place.w + sq(lobe.spread_rad) / 6.0;
        float share;
        if (sq(lobe.alpha) > 4.0 * size_squared) {
            share = disc_lobe(lobe, place.xyz, size_squared);
        } else {
            // A lobe narrower than the lamp: seven discs, one in the middle and six around it.
            share = disc_lobe(lobe, place.xyz, size_squared / 7.0);
            vec3 across = normalize(cross(place.xyz, abs(place.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0)));
            vec3 along = cross(place.xyz, across);
            for (int j = 0; j < 6; ++j) {
                float turn = float(j) * PI / 3.0;
                vec3 off = sqrt(size_squared) * (cos(turn) * across + sin(turn) * along);
                share += disc_lobe(lobe, normalize(place.xyz + off), size_squared / 7.0);
            }
            share /= 7.0;
            // The tail belongs to the lobe's share of the width alone: the pixel's own share has none.
            float narrow = 0.2 * lobe.spread_rad;
            if (widest_alpha(lobe) < narrow) {
                share = mix(disc_in_pixel(lobe.direction, place.xyz, size_squared), share, widest_alpha(lobe) / narrow);
            }
        }
        sum += share * texelFetch(u_environment_lamps, ivec2(i, 1), 0).rgb;
    }
    return sum;
}

// E/π of the lamps alone.
vec3 lamp_irradiance(vec3 normal) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < textureSize(u_environment_lamps, 0).x; ++i) {
        vec4 place = texelFetch(u_environment_lamps, ivec2(i, 0), 0);
        sum += max(dot(normal, place.xyz), 0.0) * texelFetch(u_environment_lamps, ivec2(i, 1), 0).rgb;
    }
    return sum / PI;
}
