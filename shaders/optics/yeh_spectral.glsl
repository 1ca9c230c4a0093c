// The mirror's exact reflectance, summed over the wavelengths of a fixed rule.
// Twin: gltf_iri/evaluation/yeh_spectral.py, which refines its rule until the colour settles; this one resolves
// fringes of path differences up to SPECTRAL_OPD_MAX_NM (gltf_iri/rendering/optics_tables.py). Resonances are finer:
// it holds for few cells (spec/optics-notes.md).

#include "optics/bragg.glsl"
#include "optics/spectral_rule.glsl"

// rgb = Σ ½ (R_s + R_p)(λᵢ) wᵢ
// Yeh 1988; Fourneau et al. 2024, Eq. 2-9, Appendix D
vec3 mirror_colour_yeh_spectral(
    float host_ior, float n1, float n2, float d1_nm, float d2_nm, float cells, float cos_theta_h) {
    BraggMirror mirror = bragg_mirror(host_ior, n1, n2, d1_nm, d2_nm, cells, cos_theta_h);
    vec3 colour = vec3(0.0);
    int count = spectral_count();
    for (int i = 0; i < count; ++i) {
        colour += bragg_reflectance(mirror, spectral_wavenumber(i)) * spectral_weight(i);
    }
    return colour;
}
