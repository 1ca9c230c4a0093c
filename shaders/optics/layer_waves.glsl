// What a rough layer lets pass, at the wavelengths of the coarse rule, four at once.
// Twin: gltf_iri/evaluation/layer_spectra.py; there both rules are finer.

#include "optics/bragg.glsl"
#include "optics/layer_stack.glsl"
#include "optics/rough_bragg.glsl"
#include "optics/spectral_rule.glsl"

const int LAYER_QUADS_MAX = (COARSE_COUNT + 3) / 4;

int layer_quads() { return (coarse_count() + 3) / 4; }

BraggMirror facet_mirror(float host_ior, BraggLayer layer, float cos_theta) {
    return bragg_mirror(host_ior, layer.n1, layer.n2, layer.d1_nm, layer.d2_nm, layer.cells, cos_theta);
}

// T_N(x) and U_{N−1}(x) of 1 − x and 1 + x, from the angle x is the cosine or hyperbolic cosine of. No loop, other
// than the doubling of `chebyshev_pair`: llvmpipe ends all loops of a shader after 65535 iterations without a word.
vec2 chebyshev_angle(vec2 cosine, float cells) {
    // Of |x|: angles near π would lose the digits that those near 0 keep.
    float near = min(cosine.x, cosine.y);
    vec2 tu;
    if (near > 0.0) {
        vec2 root = sqrt(vec2(near, max(cosine.x, cosine.y)));
        float turned = 2.0 * cells * quadrant_angle(root.x, root.y);
        tu = vec2(cos(turned), sin(turned) / (root.x * root.y));
    } else {
        // In a gap; e^15 is beyond what U reaches at the edge of 10⁶ cells, and all is reflected.
        float sinh_ = sqrt(-near * (2.0 - near));
        float grown = sinh_ - near;
        float log_ = grown < 0.01 ? grown * (1.0 - grown * (0.5 - grown * (1.0 / 3.0 - 0.25 * grown)))
                                  : log(1.0 + grown);
        float path = min(cells * log_, 15.0);
        float growth = exp(path);
        float sinh_n = path < 0.1 ? path * (1.0 + sq(path) * (1.0 / 6.0 + sq(path) / 120.0))
                                  : 0.5 * (growth - 1.0 / growth);
        tu = vec2(0.5 * (growth + 1.0 / growth), sinh_ > 0.0 ? sinh_n / sinh_ : cells);
    }
    // T_N(−x) = (−1)^N T_N(x), and U_{N−1} turns its sign where T_N does not.
    bool turns_t = mod(cells, 2.0) > 0.5;
    return cosine.x < cosine.y ? tu : turns_t ? vec2(-tu.x, tu.y) : vec2(tu.x, -tu.y);
}

float facet_reflectance(BraggMirror mirror, vec2 wavenumber) {
    if (mirror.is_total) return 1.0;
    BraggWaves wave = bragg_waves(mirror, wavenumber);
    float cells = float(mirror.cells);
    vec2 tu_s = chebyshev_angle(bragg_cell_cosine(mirror.s, wave), cells);
    vec2 tu_p = chebyshev_angle(bragg_cell_cosine(mirror.p, wave), cells);
    return 0.5 * (bragg_reflectance(mirror, mirror.s, wave, tu_s) + bragg_reflectance(mirror, mirror.p, wave, tu_p));
}

vec4 facet_reflectance(BraggMirror mirror, int quad) {
    int i = 4 * quad;
    return vec4(facet_reflectance(mirror, coarse_wavenumber(i)),
                facet_reflectance(mirror, coarse_wavenumber(i + 1)),
                facet_reflectance(mirror, coarse_wavenumber(i + 2)),
                facet_reflectance(mirror, coarse_wavenumber(i + 3)));
}

// R(λ, θ) where `reflects`, else T(λ, θ) = ∫ (1 − R(λ, θ_d)) F_α dθ_d; one loop for both, as compilers copy functions
// Fourneau et al. 2024, Eq. 28
void layer_spectrum(out vec4 spectrum[LAYER_QUADS_MAX], float host_ior, BraggLayer layer, float cos_theta,
                    bool reflects) {
    int quads = layer_quads();
    for (int quad = 0; quad < quads; ++quad) spectrum[quad] = vec4(0.0);
    FilterLight light = filter_light(cos_theta, reflects ? 0.0 : layer.alpha);
    int nodes = filter_count(light.alpha);
    for (int node = 0; node < nodes; ++node) {
        vec2 met = filter_node(light, node);
        BraggMirror mirror = facet_mirror(host_ior, layer, met.x);
        for (int quad = 0; quad < quads; ++quad) {
            vec4 reflected = facet_reflectance(mirror, quad);
            spectrum[quad] += met.y * (reflects ? reflected : 1.0 - reflected);
        }
    }
}

// Of the factors of R_above(h) Π_{k<above} T_k(i) T_k(o): 0 is R, the others are T, of light and viewer in turn.
void path_factor(out vec4 spectrum[LAYER_QUADS_MAX], int factor, float host_ior, BraggLayer layers[BRAGG_LAYERS_MAX],
                 int above, float cos_h, float cos_i, float cos_o) {
    int layer = factor == 0 ? above : (factor - 1) / 2;
    float cosine = factor == 0 ? cos_h : (factor & 1) == 1 ? cos_i : cos_o;
    layer_spectrum(spectrum, host_ior, layers[layer], cosine, factor == 0);
}
