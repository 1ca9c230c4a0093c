// What a pixel receives: the colour, and where it is asked for, everything that the pixel was shaded with.
// The targets are those of INPUT_TARGETS in gltf_iri/rendering/frame.py, in its order.

#include "material/surface.glsl"

// Image light as it reached the surface, occlusion included.
struct ImageLight {
    vec3 radiance;    // prefiltered, along the mirror direction
    vec3 irradiance;  // divided by π
    vec2 dfg;         // (A, B)
};

#ifdef SHADING_INPUTS
uniform int u_material;  // index into the plans

layout(location = 0) out vec4 out_colour_material;
layout(location = 1) out vec4 out_normal_metallic;
layout(location = 2) out vec4 out_position_roughness;
layout(location = 3) out vec4 out_base_color_film_factor;
layout(location = 4) out vec4 out_dielectric_f0_specular_weight;
layout(location = 5) out vec4 out_radiance_dfg_a;
layout(location = 6) out vec4 out_irradiance_dfg_b;
layout(location = 7) out vec4 out_emission_film_thickness_nm;

void write_surface(Surface s, vec3 n, ImageLight image, vec3 colour) {
    vec2 film = vec2(0.0);
#ifdef HAS_IRIDESCENCE
    film = vec2(s.iridescence_factor, s.iridescence_thickness_nm);
#endif
    out_colour_material = vec4(colour, float(u_material + 1));
    out_normal_metallic = vec4(n, s.metallic);
    out_position_roughness = vec4(v_position, s.perceptual_roughness);
    out_base_color_film_factor = vec4(s.base_color, film.x);
    out_dielectric_f0_specular_weight = vec4(s.dielectric_f0, s.specular_weight);
    out_radiance_dfg_a = vec4(image.radiance, image.dfg.x);
    out_irradiance_dfg_b = vec4(image.irradiance, image.dfg.y);
    out_emission_film_thickness_nm = vec4(s.emission, film.y);
}
#else
layout(location = 0) out vec4 out_colour;  // premultiplied; alpha is coverage

void write_surface(Surface s, vec3 n, ImageLight image, vec3 colour) {
#ifdef HAS_ALPHA_BLEND
    out_colour = vec4(colour * s.alpha, s.alpha);
#else
    out_colour = vec4(colour, 1.0);
#endif
}
#endif
