// What a lobe of facets asks of the base. A reflectance without film is F0·slope + offset, with one F·(slope + offset).
// A facet at V·H has slope 1 − w and offset w, w = (1 − V·H)⁵ (Schlick); image light has the DFG table's A and B.

#include "common/math.glsl"

struct Lobe {
    float cos_theta;     // V·H; for image light N·V
    float facet_cosine;  // V·H; for image light its mean over what the facets send, where FILM_FACET_MEAN asks for it
    float roughness;     // perceptual, for image light; 0 for light from one direction
    float slope;
    float offset;
};

Lobe facet_lobe(float v_dot_h) {
    float grazing = pow5(1.0 - v_dot_h);
    return Lobe(v_dot_h, v_dot_h, 0.0, 1.0 - grazing, grazing);
}
