// The film's reflectance over one base, by the method that the plan chose.

#include "material/surface.glsl"

#ifdef METHOD_KHR
#include "optics/khr.glsl"
#define FILM_FRESNEL iridescent_fresnel_khr
#endif
#ifdef METHOD_KHR_GUARDED
#include "optics/khr_guarded.glsl"
#define FILM_FRESNEL iridescent_fresnel_khr_guarded
#endif
#ifdef METHOD_FOURIER
#include "optics/fourier.glsl"
#define FILM_FRESNEL iridescent_fresnel_fourier
#endif
#ifdef METHOD_SPECTRAL
#include "optics/spectral.glsl"
#define FILM_FRESNEL iridescent_fresnel_spectral
#endif
#ifdef METHOD_GRANIER_HEIDRICH
#include "optics/granier_heidrich.glsl"
#define FILM_FRESNEL iridescent_fresnel_granier_heidrich
#endif

// Outside is air: KHR_materials_iridescence ignores a clearcoat's interface.
vec3 film_fresnel(Surface s, vec3 base_f0, float cos_theta) {
    return FILM_FRESNEL(1.0, s.film_ior, base_f0, s.iridescence_thickness_nm, cos_theta);
}
