// The film's exact reflectance, summed over the wavelengths of a fixed rule.
// Twin: gltf_iri/evaluation/spectral.py, which refines its rule until the colour settles; this one resolves fringes
// of path differences up to SPECTRAL_OPD_MAX_NM (gltf_iri/rendering/optics_tables.py).

#include "optics/film.glsl"
#include "optics/ior.glsl"
#include "optics/spectral_rule.glsl"

// rgb = Σ ½ (R_s + R_p)(λᵢ) wᵢ
// Belcour & Barla 2017, Eq. 2-3; Airy summation
vec3 film_colour_spectral(
    float outside_ior, float film_ior, Base red_base, Base green_base, Base blue_base, float thickness_nm,
    float cos_theta_1) {
    FilmInterfaces red = film_interfaces(outside_ior, film_ior, red_base, cos_theta_1);
    FilmInterfaces green = film_interfaces(outside_ior, film_ior, green_base, cos_theta_1);
    FilmInterfaces blue = film_interfaces(outside_ior, film_ior, blue_base, cos_theta_1);
    bool is_grey = green_base == red_base && blue_base == red_base;
    FilmPath path = film_path(outside_ior, film_ior, thickness_nm, cos_theta_1);
    vec3 colour = vec3(0.0);
    int count = spectral_count();
    for (int i = 0; i < count; ++i) {
        vec2 wave = film_wave(path, spectral_wavenumber(i));
        vec3 reflectance = vec3(film_reflectance(red, wave));
        if (!is_grey) {
            reflectance.g = film_reflectance(green, wave);
            reflectance.b = film_reflectance(blue, wave);
        }
        colour += reflectance * spectral_weight(i);
    }
    return colour;
}

// base_f0 : the base's reflectance at normal incidence under air, from which each channel gets one real index.
vec3 iridescent_fresnel_spectral(
    float outside_ior, float film_ior, vec3 base_f0, float thickness_nm, float cos_theta_1) {
    Base red = base_of_f0(base_f0.r), green = base_of_f0(base_f0.g), blue = base_of_f0(base_f0.b);
    return film_colour_spectral(outside_ior, film_ior, red, green, blue, thickness_nm, cos_theta_1);
}

// base_n + i base_k : the base's index, channel by channel.
vec3 iridescent_fresnel_spectral(
    float outside_ior, float film_ior, vec3 base_n, vec3 base_k, float thickness_nm, float cos_theta_1) {
    Base red = base_of_index(base_n.r, base_k.r);
    Base green = base_of_index(base_n.g, base_k.g);
    Base blue = base_of_index(base_n.b, base_k.b);
    return film_colour_spectral(outside_ior, film_ior, red, green, blue, thickness_nm, cos_theta_1);
}
