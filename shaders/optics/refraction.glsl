// Snell's law in cosines.
// Twin: gltf_iri/optics/refraction.py.

// x in two halves of twelve bits, whose products float32 holds exactly.
vec2 halves(float x) {
    float leading = uintBitsToFloat(floatBitsToUint(x) & 0xFFFFF000u);
    return vec2(leading, x - leading);
}

// (a + b)² as a², exact, and the rest.
vec2 square_of_halves(vec2 x) { return vec2(x.x * x.x, (2.0 * x.x + x.y) * x.y); }

// q² = (n cosθ)² = n² − n₁² + (n₁ cosθ₁)² in a medium of real index n, negative where the light is totally reflected
// Snell's law; summed in twice float32's digits. Near the critical angle, and where a matched film is met at a
// grazing angle, the three cancel, and a fringe of some thousand nanometres would shift by what float32 leaves of q.
// rest_of_index : what float32 rounds off n, where it is known.
// Returns two numbers whose sum is q².
vec2 normal_index_squared_parts(float index, float rest_of_index, float outside_ior, float cos_theta_1) {
    vec2 n1 = halves(outside_ior);
    vec2 c1 = halves(cos_theta_1);
    vec2 n1c1 = halves(n1.x * c1.x);
    n1c1.y += n1.x * c1.y + n1.y * c1.x + n1.y * c1.y;

    vec2 n1_squared = square_of_halves(n1);
    vec2 n2_squared = square_of_halves(halves(index));
    vec2 n1c1_squared = square_of_halves(n1c1);
    // Near zero the greater of the two is at least half of n₁², and its difference from it exact (Sterbenz).
    float greater = max(n2_squared.x, n1c1_squared.x);
    float lesser = min(n2_squared.x, n1c1_squared.x);
    float leading = (greater - n1_squared.x) + lesser;
    float rest = n2_squared.y - n1_squared.y + n1c1_squared.y + 2.0 * index * rest_of_index;
    return vec2(leading, rest);
}
float normal_index_squared(float index, float outside_ior, float cos_theta_1) {
    vec2 parts = normal_index_squared_parts(index, 0.0, outside_ior, cos_theta_1);
    return parts.x + parts.y;
}

// cos²θ₂ = 1 − (n₁/n₂)² (1 − cos²θ₁), negative where the light is totally reflected
// KHR_materials_iridescence, Material Interfaces
float cos_theta_2_squared(float outside_ior, float film_ior, float cos_theta_1) {
    return normal_index_squared(film_ior, outside_ior, cos_theta_1) / (film_ior * film_ior);
}
