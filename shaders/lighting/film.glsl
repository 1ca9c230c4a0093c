// The film's reflectance over each lobe's base: out of a table where there is one, else by the method that the plan
// chose. Outside is air: KHR_materials_iridescence ignores a clearcoat's interface.

#include "lighting/lobe.glsl"
#include "material/surface.glsl"

#if defined(METHOD_FOURIER) && defined(HAS_IRIDESCENCE_THICKNESS_SPREAD)
#define FILM_THICKNESS(s) s.iridescence_thickness_nm, s.iridescence_thickness_std_nm
#else
#define FILM_THICKNESS(s) s.iridescence_thickness_nm
#endif

#ifdef METHOD_KHR
#include "optics/khr.glsl"
#define FILM_FRESNEL iridescent_fresnel_khr
#endif
#ifdef METHOD_KHR_GUARDED
#include "optics/khr_guarded.glsl"
#define FILM_FRESNEL iridescent_fresnel_khr_guarded
#endif
#ifdef METHOD_FOURIER
#ifdef HAS_IRIDESCENCE_THICKNESS_SPREAD
#include "optics/fourier_spread.glsl"
#define FILM_FRESNEL iridescent_fresnel_fourier_spread
#else
#include "optics/fourier.glsl"
#define FILM_FRESNEL iridescent_fresnel_fourier
#endif
#endif
#ifdef METHOD_SPECTRAL
#include "optics/spectral.glsl"
#define FILM_FRESNEL iridescent_fresnel_spectral
#endif
#ifdef METHOD_GRANIER_HEIDRICH
#include "optics/granier_heidrich.glsl"
#define FILM_FRESNEL iridescent_fresnel_granier_heidrich
#endif
#ifdef METHOD_INCOHERENT
#include "optics/incoherent.glsl"
#define FILM_FRESNEL iridescent_fresnel_incoherent
#endif
#if defined(DIELECTRIC_TABLE) || defined(METAL_TABLE)
#include "lighting/film_table.glsl"
#endif

#ifdef HAS_DIELECTRIC
// The film's base has the specular weight in its F0. Of a grey one the compiler sees that it is, and computes once.
vec3 film_over_dielectric(Surface s, Lobe lobe) {
    vec3 base_f0 = s.specular_weight * s.dielectric_f0;
#ifdef DIELECTRIC_TABLE
    return dielectric_table(s, base_f0, lobe);
#else
#ifdef GREY_DIELECTRIC
    base_f0 = vec3(base_f0.x);
#endif
    return FILM_FRESNEL(1.0, s.film_ior, base_f0, FILM_THICKNESS(s), lobe.facet_cosine);
#endif
}
#endif

#ifdef HAS_METAL
vec3 film_over_metal(Surface s, Lobe lobe) {
#ifdef METAL_TABLE
    return metal_table(s, s.base_color, lobe);
#else
    vec3 base_f0 = s.base_color;
#ifdef GREY_METAL
    base_f0 = vec3(base_f0.x);
#endif
    return FILM_FRESNEL(1.0, s.film_ior, base_f0, FILM_THICKNESS(s), lobe.facet_cosine);
#endif
}
#endif
