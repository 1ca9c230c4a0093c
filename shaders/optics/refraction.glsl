// Snell's law in cosines.
// Twin: gltf_iri/optics/refraction.py.

#include "common/math.glsl"

// cos²θ₂ = 1 − (n₁/n₂)² (1 − cos²θ₁), negative where the light is totally reflected
// KHR_materials_iridescence, Material Interfaces; written as (n₂² − n₁² + n₁² cos²θ₁) / n₂² with the difference of
// squares factored, for 1 − sin²θ₂ loses every digit of cosθ₂ where a thin medium is met at a grazing angle.
float cos_theta_2_squared(float outside_ior, float film_ior, float cos_theta_1) {
    float contrast = (film_ior - outside_ior) * (film_ior + outside_ior);
    return (contrast + sq(outside_ior * cos_theta_1)) / sq(film_ior);
}
