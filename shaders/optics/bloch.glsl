// A Bragg mirror's colour from samples of its reflectance beside the real axis of wavenumbers, where fringes fade,
// and from its gaps, which are poles on the axis. spec/decisions/bloch.md derives it.
// Twin: gltf_iri/optics/bloch.py, whose names these are; gltf_iri/evaluation/bloch.py (`bloch_table`) fills the table.
// Light that fades in n2 alone, which Python refuses, is taken to be all reflected.

#include "common/math.glsl"
#include "optics/refraction.glsl"

uniform highp sampler2D bloch_weights;

const float BLOCH_THINNEST_NM = 1e-9;    // stands for a cell without thickness
const float BLOCH_CONTRAST_MAX = 1e6;    // light along the films; beyond, squares overflow
const float BLOCH_FADED = 4e3;           // from this |cosθ| on cosθ + i sinθ is rounding alone
const float BLOCH_FADE_MAX = 8.0;        // e^(−2·8) is rounding, and no product of what grows overflows
const float BLOCH_NOTHING = 1e-16;       // |e^(2iθ)|² of what has faded, before its squares become denormal
const float BLOCH_SCAN_RAD = 2.0;        // steps that turn θ by so much hold one gap at most
const float BLOCH_SCANS_MAX = 32.0;

// Two complex numbers, of s and p.
struct Complex2 {
    vec2 re;
    vec2 im;
};

Complex2 times(Complex2 a, Complex2 b) { return Complex2(a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re); }
Complex2 over(Complex2 a, Complex2 b) {
    vec2 square = b.re * b.re + b.im * b.im;
    return Complex2((a.re * b.re + a.im * b.im) / square, (a.im * b.re - a.re * b.im) / square);
}
Complex2 plus(Complex2 a, Complex2 b) { return Complex2(a.re + b.re, a.im + b.im); }
Complex2 scaled(vec2 factor, vec2 z) { return Complex2(factor * z.x, factor * z.y); }

// Both polarisations of a cell: X, ½Ω, Z, r, 1 − r², κ.
struct BlochCell {
    vec2 path_nm;  // of the two films
    vec2 contrast;
    vec2 omega_half;
    vec2 imbalance;
    vec2 host_r;
    vec2 host_t;
    vec2 kappa;
    vec2 opaque;  // 1 where nothing passes, else 0
    float scans;
};

// Yeh 1988; Fourneau et al. 2024, Eq. 8 and Appendix D; differences of squares as products
// gltf_iri/optics/bragg_cell.py
BlochCell bloch_cell(
    float host_ior, float n1, float n2, float d1_nm, float d2_nm, float cos_theta_h, float step_per_nm) {
    BlochCell cell;
    float q_1_squared = normal_index_squared(n1, host_ior, cos_theta_h);
    float q_2_squared = normal_index_squared(n2, host_ior, cos_theta_h);
    float q_h = max(host_ior * cos_theta_h, 1e-18);
    float q_1 = host_ior == n1 ? q_h : sqrt(max(q_1_squared, 1e-36));
    float q_2 = host_ior == n2 ? q_h : sqrt(max(q_2_squared, 1e-36));
    float n1n1 = sq(n1);
    float n2n2 = sq(n2);
    float hh = sq(host_ior);
    float tangential = hh * ((1.0 - cos_theta_h) * (1.0 + cos_theta_h));

    // Without a second film there is no contrast, at whatever angle.
    float contrast = d2_nm > 0.0 ? q_2 / q_1 : 1.0;
    vec2 x = vec2(contrast, d2_nm > 0.0 ? contrast * (n1n1 / n2n2) : 1.0);
    bvec2 is_seen = bvec2(x.x < BLOCH_CONTRAST_MAX && x.x > 1.0 / BLOCH_CONTRAST_MAX,
                          x.y < BLOCH_CONTRAST_MAX && x.y > 1.0 / BLOCH_CONTRAST_MAX);
    cell.opaque = vec2(is_seen.x ? 0.0 : 1.0, is_seen.y ? 0.0 : 1.0);
    if (q_1_squared < 0.0 || q_2_squared < 0.0) cell.opaque = vec2(1.0);
    vec2 seen = 1.0 - cell.opaque;
    x = vec2(seen.x > 0.0 ? x.x : 1.0, seen.y > 0.0 ? x.y : 1.0);
    cell.contrast = x;
    cell.omega_half = 0.5 * (x + 1.0 / x);

    float brewster = tangential * ((n1n1 + n2n2) / (n1n1 * n2n2)) - 1.0;
    float imbalance = d2_nm > 0.0 ? 0.5 * (n2 - n1) * (n2 + n1) / (q_1 * q_2) : 0.0;
    cell.imbalance = vec2(seen.x > 0.0 ? imbalance : 0.0, seen.y > 0.0 ? imbalance * brewster : 0.0);

    float rise = (host_ior - n1) * (host_ior + n1);
    vec2 total = vec2(q_h + q_1, n1n1 * q_h + hh * q_1);
    cell.host_r = vec2(rise, rise * (tangential * (n1n1 + hh) - n1n1 * hh) / total.y) / vec2(sq(total.x), total.y);
    vec2 share = vec2(q_h, n1n1 * q_h) / total;
    cell.host_t = 4.0 * share * (vec2(q_1, hh * q_1) / total);
    cell.host_r *= seen;
    cell.host_t = mix(cell.host_t, vec2(1.0), cell.opaque);
    vec2 tilt = cell.host_t / (1.0 + abs(cell.host_r));  // 1 − |r|, without cancellation
    vec2 one_minus_r = vec2(cell.host_r.x > 0.0 ? tilt.x : 1.0 - cell.host_r.x,
                            cell.host_r.y > 0.0 ? tilt.y : 1.0 - cell.host_r.y);
    vec2 one_plus_r = vec2(cell.host_r.x > 0.0 ? 1.0 + cell.host_r.x : tilt.x,
                           cell.host_r.y > 0.0 ? 1.0 + cell.host_r.y : tilt.y);
    cell.kappa = 0.5 * (x * one_minus_r + one_plus_r / x);

    float scan_nm = BLOCH_SCAN_RAD / (2.0 * PI * step_per_nm);
    float longest_nm = BLOCH_SCANS_MAX * scan_nm;
    cell.path_nm = vec2(q_1 * d1_nm, q_2 * d2_nm);
    float path_nm = cell.path_nm.x + cell.path_nm.y;
    cell.path_nm *= longest_nm / max(path_nm, longest_nm);
    cell.path_nm.x = max(cell.path_nm.x, BLOCH_THINNEST_NM);
    cell.scans = clamp(ceil(path_nm / scan_nm), 1.0, BLOCH_SCANS_MAX);
    return cell;
}

// sin φ₁, sin φ₂, cos φ₁, cos φ₂; whole turns come off before π is multiplied in
vec4 bloch_waves(BlochCell cell, float wavenumber) {
    vec2 turns = cell.path_nm * wavenumber;
    vec2 phase = 2.0 * PI * (turns - round(turns));
    return vec4(sin(phase), cos(phase));
}

// b = sin φ₁ cos φ₂ + κ cos φ₁ sin φ₂
vec2 bloch_b(BlochCell cell, vec4 wave) { return vec2(wave.x * wave.w) + cell.kappa * (wave.z * wave.y); }

// e^(2iNθ) from e^(2iθ), by squarings
Complex2 bloch_power(Complex2 base, uint cells) {
    Complex2 result = Complex2(vec2(1.0), vec2(0.0));
    for (uint rest = cells;;) {
        if ((rest & 1u) == 1u) result = times(result, base);
        rest >>= 1u;
        if (rest == 0u) break;
        base = times(base, base);
        vec2 stays = step(BLOCH_NOTHING, base.re * base.re + base.im * base.im);
        base = Complex2(stays * base.re, stays * base.im);
    }
    return result;
}

// Q = 1 − F of s and p at ν + ia
// growth : cosh and sinh of 2πa·path, film by film; is_deep : the mirror's far end is not seen
Complex2 bloch_sample(BlochCell cell, uint cells, vec4 wave, vec4 growth, bool is_deep) {
    vec2 sin_1 = vec2(wave.x * growth.x, wave.z * growth.z);
    vec2 sin_2 = vec2(wave.y * growth.y, wave.w * growth.w);
    vec2 cos_1 = vec2(wave.z * growth.x, -wave.x * growth.z);
    vec2 cos_2 = vec2(wave.w * growth.y, -wave.y * growth.w);
    vec2 first = vec2(sin_1.x * cos_2.x - sin_1.y * cos_2.y, sin_1.x * cos_2.y + sin_1.y * cos_2.x);
    vec2 mixed = vec2(cos_1.x * sin_2.x - cos_1.y * sin_2.y, cos_1.x * sin_2.y + cos_1.y * sin_2.x);
    vec2 sines = vec2(sin_1.x * sin_2.x - sin_1.y * sin_2.y, sin_1.x * sin_2.y + sin_1.y * sin_2.x);
    vec2 cosines = vec2(cos_1.x * cos_2.x - cos_1.y * cos_2.y, cos_1.x * cos_2.y + cos_1.y * cos_2.x);

    Complex2 x = Complex2(cosines.x - cell.omega_half * sines.x, cosines.y - cell.omega_half * sines.y);
    Complex2 b = Complex2(first.x + cell.kappa * mixed.x, first.y + cell.kappa * mixed.y);
    Complex2 b_r = scaled(-cell.host_r * cell.imbalance, sines);
    // sin²θ = (b₀ − Z sin φ₂)(b₀ + Z sin φ₂), with b₀ = sin φ₁ cos φ₂ + ½Ω cos φ₁ sin φ₂ and ½Ω ± Z = X^±1;
    // 1 − cos²θ cancels for thin cells, the other for strong contrasts.
    vec2 lifted = mixed - sin_2;  // (cos φ₁ − 1) sin φ₂
    Complex2 b_0 = Complex2(first.x + cell.omega_half * lifted.x, first.y + cell.omega_half * lifted.y);
    Complex2 low = plus(b_0, scaled(1.0 / cell.contrast, sin_2));
    Complex2 high = plus(b_0, scaled(cell.contrast, sin_2));
    vec2 is_weak = step(cell.imbalance * cell.imbalance * dot(sin_2, sin_2), vec2(1.0));
    low = Complex2(mix(1.0 - x.re, low.re, is_weak), mix(-x.im, low.im, is_weak));
    high = Complex2(mix(1.0 + x.re, high.re, is_weak), mix(x.im, high.im, is_weak));
    Complex2 s_squared = times(low, high);
    // Its length without its square, which would overflow.
    vec2 longer = max(max(abs(s_squared.re), abs(s_squared.im)), 1e-36);
    vec2 shorter = min(abs(s_squared.re), abs(s_squared.im)) / longer;
    vec2 size = longer * sqrt(1.0 + shorter * shorter);
    vec2 large = sqrt(0.5 * (size + abs(s_squared.re)));
    vec2 small = 0.5 * s_squared.im / max(large, 1e-18);
    vec2 is_right = step(vec2(0.0), s_squared.re);
    Complex2 s = Complex2(mix(small, large, is_right), mix(large, small, is_right));
    // Of ±θ the one that fades: |e^(iθ)| < 1.
    vec2 turn = 1.0 - 2.0 * step(vec2(1e-30), x.im * s.re - x.re * s.im);
    s = Complex2(turn * s.re, turn * s.im);

    Complex2 z = Complex2(vec2(0.0), vec2(0.0));
    if (!is_deep) {
        vec2 fading = step(x.re * x.re + x.im * x.im, vec2(sq(BLOCH_FADED)));
        Complex2 root = Complex2(fading * (x.re - s.im), fading * (x.im + s.re));
        z = bloch_power(times(root, root), cells);
    }
    Complex2 even = times(s, Complex2(1.0 + z.re, z.im));
    Complex2 odd = Complex2(1.0 - z.re, -z.im);
    Complex2 squares = plus(times(s, s), times(b_r, b_r));
    Complex2 out_ = over(squares, b);
    out_ = Complex2(out_.re + b_r.im, out_.im - b_r.re);
    Complex2 in_ = Complex2(b.re - b_r.im, b.im + b_r.re);
    Complex2 f = over(plus(even, times(out_, odd)), plus(even, times(in_, odd)));
    return Complex2(mix(1.0 - cell.host_t * f.re, vec2(1.0), cell.opaque), -cell.host_t * f.im * (1.0 - cell.opaque));
}

// The weight of a pole so many steps from the grid's first point, by a line between the table's entries.
vec3 bloch_gap_weight(float place) {
    ivec2 size = textureSize(bloch_weights, 0);
    float entries = float(size.y - 3);
    int column = clamp(int(place), 0, size.x - 2);
    float entry = entries * clamp(place - float(column), 0.0, 1.0);
    int row = min(int(entry), size.y - 4);
    vec3 below = texelFetch(bloch_weights, ivec2(column, 2 + row), 0).rgb;
    vec3 above = texelFetch(bloch_weights, ivec2(column, 3 + row), 0).rgb;
    return below + (entry - float(row)) * (above - below);
}

float of_polarisation(bool is_s, vec2 both) { return is_s ? both.x : both.y; }

// The colour of the pole in a polarisation's gap, where b is `before` at `start` and `here` a scan beyond it
// ρ = (1 − r²)² τ (σ sinh χ − b_r τ) / {[1 − r² + (r sin φ₁)²(1 − τ²)] b′}, τ = tanh Nχ
vec3 bloch_gap(BlochCell cell, bool is_s, uint cells, vec2 grid, float start, vec2 before, vec2 here) {
    float scan = 1.0 / cell.scans;
    float low = of_polarisation(is_s, before), high = of_polarisation(is_s, here);
    float kappa = of_polarisation(is_s, cell.kappa);
    vec2 turn = 2.0 * PI * grid.y * cell.path_nm;
    float slope_cosines = turn.x + kappa * turn.y;
    float slope_sines = turn.y + kappa * turn.x;
    float place = scan * clamp(low / (low - high), 0.0, 1.0);
    vec4 wave = bloch_waves(cell, grid.x + grid.y * (start + place));
    float slope = slope_cosines * (wave.z * wave.w) - slope_sines * (wave.x * wave.y);
    place = clamp(place - of_polarisation(is_s, bloch_b(cell, wave)) / slope, 0.0, scan);
    wave = bloch_waves(cell, grid.x + grid.y * (start + place));
    slope = slope_cosines * (wave.z * wave.w) - slope_sines * (wave.x * wave.y);

    float t = of_polarisation(is_s, cell.host_t);
    float off = of_polarisation(is_s, cell.imbalance) * wave.y;
    float tilt = of_polarisation(is_s, cell.host_r) * wave.x;
    float sinh_chi = abs(off) * sqrt(t + sq(tilt));
    // e^(−2Nχ); asinh keeps the digits of a narrow gap, which λ^(2N) in float32 does not.
    float growth = sinh_chi > 0.01 ? log(sinh_chi + sqrt(1.0 + sq(sinh_chi))) : sinh_chi * (1.0 - sq(sinh_chi) / 6.0);
    float twice = 2.0 * float(cells) * growth;
    float z = exp(-min(twice, 80.0));
    float tau = twice < 0.02 ? 0.5 * twice : (1.0 - z) / (1.0 + z);
    float x = wave.z * wave.w - of_polarisation(is_s, cell.omega_half) * (wave.x * wave.y);
    float signed_sinh = (x < 0.0 ? -sinh_chi : sinh_chi) + off * tilt * tau;
    float faded = 4.0 * z / sq(1.0 + z);
    float strength = sq(t) * tau * signed_sinh / ((t + sq(tilt) * faded) * slope);
    return strength * bloch_gap_weight(start + place);
}

// The colours of the poles of all gaps, of s and p. From the last gap on each pixel walks as far as its own next one:
// software renderers compute a gap for every pixel wherever one of eight asks for it. Loops are left at their ends,
// for else what follows the test runs once more for nobody.
vec3 bloch_gaps(BlochCell cell, uint cells, vec2 grid, int samples) {
    float scan = 1.0 / cell.scans;
    float last = float(samples - 1) * cell.scans;
    float at = 0.0;
    vec2 before = vec2(0.0), here = bloch_b(cell, bloch_waves(cell, grid.x));
    bvec2 is_gap = bvec2(false);
    vec3 colour = vec3(0.0);
    for (;;) {
        for (;;) {
            if (!any(is_gap)) {
                before = here;
                at += 1.0;
                here = bloch_b(cell, bloch_waves(cell, grid.x + grid.y * (scan * at)));
                is_gap = notEqual(lessThan(before, vec2(0.0)), lessThan(here, vec2(0.0)));
            }
            if (any(is_gap) || !(at < last)) break;
        }
        vec3 pole = bloch_gap(cell, is_gap.x, cells, grid, scan * (at - 1.0), before, here);
        colour += any(is_gap) ? pole : vec3(0.0);
        is_gap = bvec2(false, is_gap.x && is_gap.y);
        if (!(any(is_gap) || at < last)) break;
    }
    return colour;
}

// rgb = ½ Σ over s and p of Σ Re Q w + Σ Im Q w′ + Σ ρ w″
vec3 bragg_reflectance_bloch(
    float host_ior, float n1, float n2, float d1_nm, float d2_nm, float cells, float cos_theta_h) {
    int samples = textureSize(bloch_weights, 0).x;
    vec2 grid = vec2(texelFetch(bloch_weights, ivec2(0, 0), 0).a, texelFetch(bloch_weights, ivec2(1, 0), 0).a);
    float height = texelFetch(bloch_weights, ivec2(2, 0), 0).a;
    BlochCell cell = bloch_cell(host_ior, n1, n2, d1_nm, d2_nm, cos_theta_h, grid.y);
    if (cell.opaque.x > 0.0 && cell.opaque.y > 0.0) return vec3(1.0);
    uint number = uint(cells + 0.5);
    vec2 fade = 2.0 * PI * height * cell.path_nm;
    bool is_deep = cells * (fade.x + fade.y) > BLOCH_FADE_MAX;
    vec2 grown = exp(min(fade, BLOCH_FADE_MAX));
    vec4 growth = 0.5 * vec4(grown + 1.0 / grown, grown - 1.0 / grown);
    // The difference of nearly equal numbers.
    growth.z = fade.x < 0.1 ? fade.x * (1.0 + sq(fade.x) * (1.0 / 6.0 + sq(fade.x) / 120.0)) : growth.z;
    growth.w = fade.y < 0.1 ? fade.y * (1.0 + sq(fade.y) * (1.0 / 6.0 + sq(fade.y) / 120.0)) : growth.w;

    vec3 colour = bloch_gaps(cell, number, grid, samples);
    for (int k = 0;;) {
        vec4 wave = bloch_waves(cell, grid.x + grid.y * float(k));
        Complex2 sample_ = bloch_sample(cell, number, wave, growth, is_deep);
        colour += (sample_.re.x + sample_.re.y) * texelFetch(bloch_weights, ivec2(k, 0), 0).rgb +
                  (sample_.im.x + sample_.im.y) * texelFetch(bloch_weights, ivec2(k, 1), 0).rgb;
        if (++k >= samples) break;
    }
    return 0.5 * colour;
}
