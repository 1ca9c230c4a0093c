// The eye's sensitivities in Fourier space: the colour of a fringe of given optical path difference.
// Twin: gltf_iri/colour/sensitivity.py, whose table the generated constants come from.

#include "common/math.glsl"
#include "generated/film_constants.glsl"
#include "optics/turns.glsl"

// S(D, φ) = M Σ A cos(2π D/λ + φ) exp(−(D/L)²)
// Belcour & Barla 2017, section 4; KHR_materials_iridescence, Analytic Spectral Integration. The text's val, pos and
// var in the unit-free form A = val √(2π var) / 1.0685e-7, λ = 1e9/pos nm, L = 1e9/(2π √var) nm, which half floats
// can hold as well; x̄ has a second lobe.
vec3 eval_sensitivity(float opd_nm, vec3 shift) {
    vec3 xyz = SENSITIVITY_AMPLITUDE * cos_turns(opd_nm / SENSITIVITY_WAVELENGTH_NM, shift) *
               exp(-sq(opd_nm / SENSITIVITY_LENGTH_NM));
    float second_cycles = opd_nm / SENSITIVITY_SECOND_WAVELENGTH_NM;
    xyz.x += SENSITIVITY_SECOND_AMPLITUDE * cos_turns(vec3(second_cycles), shift).x *
             exp(-sq(opd_nm / SENSITIVITY_SECOND_LENGTH_NM));
    return XYZ_TO_REC709 * xyz;
}
