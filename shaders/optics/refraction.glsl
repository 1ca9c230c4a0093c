// Snell's law in cosines.
// Twin: gltf_iri/optics/refraction.py.

// x in two halves of twelve bits, whose products float32 holds exactly.
vec2 halves(float x) {
    float leading = uintBitsToFloat(floatBitsToUint(x) & 0xFFFFF000u);
    return vec2(leading, x - leading);
}

// (a + b)² as a², exact, and the rest.
vec2 square_of_halves(vec2 x) { return vec2(x.x * x.x, (2.0 * x.x + x.y) * x.y); }

// cos²θ₂ = 1 − (n₁/n₂)² (1 − cos²θ₁), negative where the light is totally reflected
// KHR_materials_iridescence, Material Interfaces; summed as (n₂² − n₁² + (n₁ cosθ₁)²) / n₂² in twice float32's
// digits. Near the critical angle, and where a matched film is met at a grazing angle, the three cancel, and a
// fringe of some thousand nanometres would shift by what float32 leaves of cosθ₂.
float cos_theta_2_squared(float outside_ior, float film_ior, float cos_theta_1) {
    vec2 n1 = halves(outside_ior);
    vec2 c1 = halves(cos_theta_1);
    vec2 n1c1 = halves(n1.x * c1.x);
    n1c1.y += n1.x * c1.y + n1.y * c1.x + n1.y * c1.y;

    vec2 n1_squared = square_of_halves(n1);
    vec2 n2_squared = square_of_halves(halves(film_ior));
    vec2 n1c1_squared = square_of_halves(n1c1);
    // Near zero the greater of the two is at least half of n₁², and its difference from it exact (Sterbenz).
    float greater = max(n2_squared.x, n1c1_squared.x);
    float lesser = min(n2_squared.x, n1c1_squared.x);
    float leading = (greater - n1_squared.x) + lesser;
    float rest = n2_squared.y - n1_squared.y + n1c1_squared.y;
    return (leading + rest) / (film_ior * film_ior);
}
