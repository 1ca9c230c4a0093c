// A rough Bragg layer: facets that are tiny Bragg mirrors, and what of light passes between them unbent.
// Twin: gltf_iri/optics/rough_bragg.py. Angles come as θ_d − θ_i, of which float32 keeps the digits at the filter's peak.

#include "common/math.glsl"
#include "generated/bragg_constants.glsl"

// G₁ = 2c / (c + √(α² + (1 − α²)c²)); 1 for light along a smooth layer
// Fourneau et al. 2024, Eq. 19
float g1_smith(float cos_theta, float alpha) {
    float total = cos_theta + sqrt(sq(alpha) + (1.0 - sq(alpha)) * sq(cos_theta));
    return total > 0.0 ? 2.0 * cos_theta / total : 1.0;
}

// D(h) G₁(i) G₁(o) / (4 cosθ_i cosθ_o), with G₁/(2c) = 1/(c + √…), which is finite at grazing angles
// Fourneau et al. 2024, Eq. 17 to 19
float facet_weight(float n_cross_h_squared, float cos_theta_i, float cos_theta_o, float alpha) {
    float a2 = sq(alpha);
    float spread = n_cross_h_squared + a2 * (1.0 - n_cross_h_squared);
    float seen_i = cos_theta_i + sqrt(a2 + (1.0 - a2) * sq(cos_theta_i));
    float seen_o = cos_theta_o + sqrt(a2 + (1.0 - a2) * sq(cos_theta_o));
    // A quotient of its own: the square of a narrow spread is below float32's least number.
    return alpha / spread * (alpha / spread) / (PI * seen_i * seen_o);
}

// cos x and sin x for |x| ≤ π/4 to float32's last digit, which sin and cos of OpenGL need not keep.
vec2 short_turn(float x) {
    float x2 = sq(x);
    return vec2(1.0 - x2 * (0.5 - x2 * (1.0 / 24.0 - x2 * (1.0 / 720.0 - x2 / 40320.0))),
                x * (1.0 - x2 * (1.0 / 6.0 - x2 * (1.0 / 120.0 - x2 * (1.0 / 5040.0 - x2 / 362880.0)))));
}

// The angle of (x, y) in [0, π/2], of four times tan ¼θ: the series of a small arc tangent. OpenGL's loses three digits.
float quadrant_angle(float y, float x) {
    float length_ = sqrt(sq(x) + sq(y)) + x;
    float t = length_ > 0.0 ? y / length_ : 0.0;
    t /= 1.0 + sqrt(1.0 + sq(t));
    float t2 = sq(t);
    float series = 1.0 / 11.0 - t2 * (1.0 / 13.0 - t2 * (1.0 / 15.0 - t2 / 17.0));
    return 4.0 * t * (1.0 - t2 * (1.0 / 3.0 - t2 * (1.0 / 5.0 - t2 * (1.0 / 7.0 - t2 * (1.0 / 9.0 - t2 * series)))));
}

// ¼ (J₁ + J₂) of one sign: p + q and p − q; sine = ∓ q sin ψmax / (p + q cos ψmax)
float filter_integral(float plus, float minus, float sine, float tangent_above, float tangent_below) {
    float squared = plus * minus;
    float angle = quadrant_angle(sqrt(minus) * tangent_above, sqrt(plus) * tangent_below);
    float j_1 = 2.0 / sqrt(squared) * angle;
    return 0.25 * (j_1 + (0.5 * (plus + minus) * j_1 + sine) / squared);
}

// One direction of light on one roughness.
struct FilterLight {
    float cos_i;
    float sin_i;
    float alpha;
    float theta_i;
    float scale;  // 2 G₁² α² / (π cosθ_i)
};

FilterLight filter_light(float cos_theta_i, float alpha) {
    float c = clamp(cos_theta_i, 1e-9, 1.0);  // 0 would divide by it, and what is above 1 has no sine
    float s = sqrt((1.0 - c) * (1.0 + c));
    float g1_over_cosine = 2.0 / (c + sqrt(sq(alpha) + (1.0 - sq(alpha)) * sq(c)));
    return FilterLight(c, s, alpha, quadrant_angle(s, c), 2.0 / PI * sq(g1_over_cosine * alpha) * c);
}

// x : cosθ_d, y : F_α(θ_i, θ_d), 1/rad, at θ_d = θ_i + offset, in [0, π/2]
// Fourneau et al. 2024, Eq. 26 and 29, closed as the twin tells
vec2 transmission_filter(FilterLight light, float offset_rad) {
    vec2 half_turn = short_turn(0.5 * offset_rad);
    vec2 turn = vec2(1.0 - 2.0 * sq(half_turn.y), 2.0 * half_turn.x * half_turn.y);
    float cos_d = light.cos_i * turn.x - light.sin_i * turn.y;
    float sin_d = light.sin_i * turn.x + light.cos_i * turn.y;
    // cos and sin of ½(θ_i + θ_d) = θ_i + ½ offset
    vec2 middle = vec2(light.cos_i * half_turn.x - light.sin_i * half_turn.y,
                       light.sin_i * half_turn.x + light.cos_i * half_turn.y);
    float total = (middle.x - middle.y) * (middle.x + middle.y);
    float difference = turn.x;
    // tan ½ψmax = above/below; without a horizon ψmax is π.
    float above = total < 0.0 ? sqrt(difference) : 1.0;
    float below = total < 0.0 ? sqrt(-total) : 0.0;
    float root = sqrt((1.0 - light.alpha) * (1.0 + light.alpha));
    float least = sq(light.alpha) / (1.0 + root);
    float sine = root * sqrt(max(-difference * total, 0.0));
    vec2 plus = least + 2.0 * root * half_turn.yx * half_turn.yx;
    vec2 minus = least + 2.0 * root * middle.yx * middle.yx;
    float integral = filter_integral(plus.x, minus.x, sine, above, below) +
                     filter_integral(plus.y, minus.y, -sine, above, below);
    return vec2(max(cos_d, 0.0), max(light.scale * cos_d * sin_d * integral, 0.0));
}
float transmission_filter(float cos_theta_i, float offset_rad, float alpha) {
    return transmission_filter(filter_light(cos_theta_i, alpha), offset_rad).y;
}

// How many nodes a roughness wants: a smooth layer's facets are all met at θ_i.
int filter_count(float alpha) { return alpha > 0.0 ? FILTER_NODES : 1; }

// x : cosθ_d, y : weight of ∫ f(cosθ_d) F_α dθ_d at node 0 … filter_count − 1
// The twin's filter_nodes(…, count=FILTER_POINTS). Each panel lies on one side of θ_i, so that θ_d − θ_i = ± α cot y,
// y = π/2 − |x|, keeps its digits far from the peak too.
vec2 filter_node(FilterLight light, int node) {
    int panel = node / FILTER_POINTS;
    int point = node - panel * FILTER_POINTS;
    // The ends as θ − θ_i: 0, the lesser and the greater of θ_i and π/2 − θ_i, π/2.
    float turned = 0.5 * PI - 2.0 * light.theta_i;
    vec4 ends = vec4(-light.theta_i, min(0.0, turned), max(0.0, turned), 0.5 * PI - light.theta_i);
    float first = panel == 0 ? ends.x : panel == 1 ? ends.y : ends.z;
    float last = panel == 0 ? ends.y : panel == 1 ? ends.z : ends.w;
    float y_first = quadrant_angle(light.alpha, abs(first));
    float y_last = quadrant_angle(light.alpha, abs(last));
    float inside = FILTER_INSIDE[point];
    float y = y_first * FILTER_INSIDE[FILTER_POINTS - 1 - point] + y_last * inside;
    vec2 half_turn = short_turn(0.5 * y);
    float sine = 2.0 * half_turn.x * half_turn.y;
    float cosine = (half_turn.x - half_turn.y) * (half_turn.x + half_turn.y);
    float offset = light.alpha * cosine / sine;
    offset = first + last < 0.0 ? max(-offset, ends.x) : min(offset, ends.w);
    vec2 met = transmission_filter(light, offset);
    float weight = met.y * light.alpha / sq(sine) * abs(y_last - y_first) * FILTER_WEIGHTS[point];
    return light.alpha > 0.0 ? vec2(met.x, weight) : vec2(light.cos_i, 1.0);
}
