// Where a Bragg mirror's reflectance turns: band-gap edges, Airy and zero points, in units in which modes are
// whole numbers. Twin: gltf_iri/optics/landmarks.py, which derives the equations.

#include "common/math.glsl"
#include "optics/turns.glsl"

// As in the twin. Float32's own smallest numbers keep 0/0 away.
const int LANDMARK_HALVINGS = 10;
const int LANDMARK_NEWTON_MAX = 2;
const float LANDMARK_TINY = 1e-30;
const float LANDMARK_LEAST_SLOPE = 0.05;

bool is_odd(float mode) { return mode - 2.0 * floor(0.5 * mode) == 1.0; }

// 2x/π of the root x of sin x = κ sin(ρx + φ), phase = (sin φ, cos φ): a closed-form guess, then Newton steps
float landmark_offset(float kappa, vec2 phase, float rho, int newton_steps) {
    float drive = kappa * phase.x;
    float root = sqrt(max(1.0 - drive * drive * (1.0 - rho * rho), 0.0));
    float tangent = drive / max(root - kappa * rho * phase.y, LANDMARK_TINY);
    // arctan to 0.005
    float size = abs(tangent);
    float x = size <= 1.0 ? size / (1.0 + 0.28 * size * size) : 0.5 * PI - 1.0 / (size + 0.28 / size);
    x = tangent < 0.0 ? -x : x;
    for (int i = 0; i < newton_steps; ++i) {
        float sin_r = sin(rho * x);
        float cos_r = cos(rho * x);
        float value = sin(x) - kappa * (phase.x * cos_r + phase.y * sin_r);
        float slope = cos(x) - kappa * rho * (phase.y * cos_r - phase.x * sin_r);
        // Grazing light has flat slopes: a step must not leave the bracket.
        x = clamp(x - value / max(slope, LANDMARK_LEAST_SLOPE), -0.5 * PI, 0.5 * PI);
    }
    return x * (2.0 / PI);
}

// sin φ and cos φ for the edges of a mode, turned so that the root is positive
vec2 edge_phase(float mode, float rho) {
    vec2 phase = sincos_turns(0.25 * (rho * mode));
    phase = is_odd(mode) ? vec2(phase.y, -phase.x) : phase;
    return phase.x < 0.0 ? -phase : phase;
}

// (1 − r²) cos KΛ
// Fourneau et al. 2024, Eq. 8 and 36
float band_gap_function(float t, float rho, float r_squared) {
    return sincos_turns(0.5 * t).y - r_squared * sincos_turns(0.5 * (rho * t)).y;
}

// Where the falling ±(1 − r²) cos KΛ passes `level`.
// A loop of no rounds, not a branch around it or a fixed number: software renderers walk both sides of branches.
float halve(
    float low, float high, float sign_of_mode, float level, float rho, float r_squared, int halvings) {
    for (int i = 0; i < halvings; ++i) {
        float middle = 0.5 * (low + high);
        bool is_before = sign_of_mode * band_gap_function(middle, rho, r_squared) > level;
        low = is_before ? middle : low;
        high = is_before ? high : middle;
    }
    return 0.5 * (low + high);
}

// sin φ and cos φ of a band's start, Airy point and end, the same for s and p.
struct BandPhases {
    vec2 start;
    vec2 airy;
    vec2 end;
};

BandPhases band_phases(float m, float rho) {
    vec2 middle = sincos_turns(0.25 * (rho * (2.0 * m + 1.0)));
    vec2 airy = is_odd(m) ? vec2(middle.y, -middle.x) : vec2(-middle.y, middle.x);
    return BandPhases(edge_phase(m, rho), airy, edge_phase(m + 1.0, rho));
}

// Start, Airy point and end of the pass band between the modes m and m + 1
// Fourneau et al. 2024, §3.2.1
vec3 landmark_band(float m, float rho, float r_squared, BandPhases phases, int newton_steps) {
    float amplitude = sqrt(r_squared);
    float start = m + landmark_offset(amplitude, phases.start, rho, newton_steps);
    float end = m + 1.0 - landmark_offset(amplitude, phases.end, -rho, newton_steps);
    float airy = clamp(m + 0.5 + 0.5 * landmark_offset(r_squared, phases.airy, rho, newton_steps), m, m + 1.0);
    return vec3(min(start, airy), airy, max(end, airy));
}

// The same by ten halvings between modes, as published; by none it is not to be used
vec3 halved_band(float m, float rho, float r_squared, int halvings) {
    float even = is_odd(m) ? -1.0 : 1.0;
    float airy = halve(m, m + 1.0, even, 0.0, rho, r_squared, halvings);
    float start = halve(m, airy, even, 1.0 - r_squared, rho, r_squared, halvings);
    float end = halve(airy, m + 1.0, even, r_squared - 1.0, rho, r_squared, halvings);
    // No gap is at ω = 0, and none anywhere in a cell of equal media.
    bool is_matched = r_squared == 0.0;
    return vec3(is_matched || m == 0.0 ? m : start, airy, is_matched ? m + 1.0 : end);
}

// Where the band's envelope is 0, or its Airy point where that lies in a gap
// Fourneau et al. 2024, Eq. 12
float zero_point(vec3 band, float rho) {
    float share = max(1.0 - rho, LANDMARK_TINY);
    float zero = floor(0.5 * share * band.z) * (2.0 / share);
    return band.x < zero && zero < band.z ? zero : band.y;
}

// 1 − R^e at t, 0 inside gaps
// Fourneau et al. 2024, Eq. 11, in half angles
float envelope_transmittance(float t, float rho, float r_squared) {
    vec2 s = sincos_turns(0.25 * t);
    vec2 d = sincos_turns(0.25 * (rho * t));
    vec2 factors = s * s - r_squared * (d * d);
    float mean = s.x * s.y - r_squared * (d.x * d.y);
    // Rounding at the edges, and 0/0 at closed gaps, must not leave [0, 1].
    return clamp(factors.x * factors.y / max(mean * mean, LANDMARK_TINY), 0.0, 1.0);
}
