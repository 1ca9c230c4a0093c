// Complex numbers as vec2(real, imaginary), without the overflow of squares.

vec2 complex_product(vec2 a, vec2 b) { return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x); }

// Divided by the greater part first: the squares of the rest lie in [1, 2].
vec2 complex_quotient(vec2 a, vec2 b) {
    float size = max(abs(b.x), abs(b.y));
    vec2 unit = b / size;
    return complex_product(a / size, vec2(unit.x, -unit.y)) / dot(unit, unit);
}

// The root with both parts ≥ 0 of x + iy, y ≥ 0: under exp(−iωt) the wave that runs, or fades, onward.
vec2 complex_root(vec2 z) {
    float size = max(abs(z.x), abs(z.y));
    if (size == 0.0) {
        return vec2(0.0);
    }
    vec2 unit = z / size;
    float greater = sqrt(0.5 * (length(unit) + abs(unit.x)));
    float lesser = 0.5 * abs(unit.y) / greater;
    return sqrt(size) * (z.x >= 0.0 ? vec2(greater, lesser) : vec2(lesser, greater));
}
