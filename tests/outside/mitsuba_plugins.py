"""What Mitsuba lacks: a film over a mirror, over rough metal and over a pane, and a camera of pixel centres.

Import it after a variant is chosen. Mitsuba itself traces, draws lights and wavelengths, and turns spectra
into colours; the facets' distribution and the masking of each direction are its own too.
"""

from __future__ import annotations

from typing import Any

import drjit as dr
import mitsuba as mi
from matrix_film import film_reflectance

__all__ = ["register_plugins"]


def _reflectance(film: tuple[float, float, float], cosine: Any, wavelengths: Any) -> Any:
    film_ior, thickness_nm, base_ior = film
    # From behind nothing is reflected; the cosine only has to stay away from 0.
    cosine = dr.maximum(cosine, 1e-4)
    return mi.UnpolarizedSpectrum(
        film_reflectance(film_ior, thickness_nm, base_ior, cosine, wavelengths, dr.cos)
    )


class _FilmBSDF(mi.BSDF):  # type: ignore[misc]
    """A front side under a film: film_ior, thickness_nm, base_ior."""

    def __init__(self, props: Any, *lobes: Any) -> None:
        mi.BSDF.__init__(self, props)
        self.film = (props["film_ior"], props["thickness_nm"], props["base_ior"])
        self.m_components = [lobe | mi.BSDFFlags.FrontSide for lobe in lobes]
        self.m_flags = 0
        for component in self.m_components:
            self.m_flags |= component

    def eval(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
        return mi.UnpolarizedSpectrum(0.0)

    def pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
        return mi.Float(0.0)

    def eval_pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
        return self.eval(ctx, si, wo, active), self.pdf(ctx, si, wo, active)

    def to_string(self) -> str:
        return f"{type(self).__name__}{self.film}"


class FilmMirror(_FilmBSDF):
    """A smooth film on metal."""

    def __init__(self, props: Any) -> None:
        super().__init__(props, mi.BSDFFlags.DeltaReflection)

    def sample(self, ctx: Any, si: Any, sample1: Any, sample2: Any, active: Any = True) -> Any:
        cosine = mi.Frame3f.cos_theta(si.wi)
        chosen = dr.zeros(mi.BSDFSample3f)
        chosen.wo = mi.reflect(si.wi)
        chosen.pdf = 1.0
        chosen.eta = 1.0
        chosen.sampled_type = +mi.BSDFFlags.DeltaReflection
        weight = _reflectance(self.film, cosine, si.wavelengths)
        return chosen, dr.select(active & (cosine > 0.0), weight, 0.0)


class RoughFilm(_FilmBSDF):
    """A film on rough metal: GGX facets, each under the same film; masking and shadowing height-correlated.

    f = F D G / (4 |cosθ_i cosθ_o|), G = 1 / (1 + Λ_i + Λ_o), Λ = 1 / G₁ − 1; Heitz 2014, Eq. 15, 43 and 99.
    """

    def __init__(self, props: Any) -> None:
        super().__init__(props, mi.BSDFFlags.GlossyReflection)
        self.alpha = props["alpha"]

    def _facets(self) -> Any:
        return mi.MicrofacetDistribution(mi.MicrofacetType.GGX, self.alpha)

    def _masking(self, facets: Any, wi: Any, wo: Any, m: Any) -> Any:
        # Below the horizon G₁ is 0 and the lobe is not read; the floor keeps the division defined.
        seen, lit = (dr.maximum(facets.smith_g1(way, m), 1e-6) for way in (wi, wo))
        return 1.0 / (1.0 / seen + 1.0 / lit - 1.0)

    def eval(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
        above = active & (mi.Frame3f.cos_theta(si.wi) > 0.0) & (mi.Frame3f.cos_theta(wo) > 0.0)
        facets, m = self._facets(), dr.normalize(si.wi + wo)
        masking = dr.select(above, self._masking(facets, si.wi, wo, m), 0.0)
        lobe = facets.eval(m) * masking / (4.0 * mi.Frame3f.cos_theta(si.wi))
        weight = _reflectance(self.film, dr.dot(si.wi, m), si.wavelengths) * lobe
        return dr.select(above, weight, 0.0)

    def pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
        m = dr.normalize(si.wi + wo)
        above = active & (mi.Frame3f.cos_theta(si.wi) > 0.0) & (mi.Frame3f.cos_theta(wo) > 0.0)
        return dr.select(above, self._facets().pdf(si.wi, m) / (4.0 * dr.dot(wo, m)), 0.0)

    def sample(self, ctx: Any, si: Any, sample1: Any, sample2: Any, active: Any = True) -> Any:
        facets = self._facets()
        m, density = facets.sample(si.wi, sample2)
        chosen = dr.zeros(mi.BSDFSample3f)
        chosen.wo = mi.reflect(si.wi, m)
        chosen.pdf = density / (4.0 * dr.dot(chosen.wo, m))
        chosen.eta = 1.0
        chosen.sampled_type = +mi.BSDFFlags.GlossyReflection
        above = active & (density > 0.0) & (mi.Frame3f.cos_theta(si.wi) > 0.0)
        above &= mi.Frame3f.cos_theta(chosen.wo) > 0.0
        masking = self._masking(facets, si.wi, chosen.wo, m) / dr.maximum(facets.smith_g1(si.wi, m), 1e-6)
        weight = _reflectance(self.film, dr.dot(si.wi, m), si.wavelengths) * masking
        return chosen, dr.select(above, weight, 0.0)


class FilmPane(_FilmBSDF):
    """A film on a clear pane without thickness: what it does not reflect goes straight on.

    Both ways are followed equally often: here the little that is reflected comes from the brighter side.
    """

    def __init__(self, props: Any) -> None:
        super().__init__(props, mi.BSDFFlags.DeltaReflection, mi.BSDFFlags.Null)

    def sample(self, ctx: Any, si: Any, sample1: Any, sample2: Any, active: Any = True) -> Any:
        cosine = mi.Frame3f.cos_theta(si.wi)
        reflected = _reflectance(self.film, cosine, si.wavelengths)
        is_reflected = sample1 < 0.5
        chosen = dr.zeros(mi.BSDFSample3f)
        chosen.wo = dr.select(is_reflected, mi.reflect(si.wi), -si.wi)
        chosen.pdf = 0.5
        chosen.eta = 1.0
        chosen.sampled_type = dr.select(is_reflected, +mi.BSDFFlags.DeltaReflection, +mi.BSDFFlags.Null)
        chosen.sampled_component = dr.select(is_reflected, 0, 1)
        weight = dr.select(is_reflected, reflected, 1.0 - reflected) / chosen.pdf
        return chosen, dr.select(active & (cosine > 0.0), weight, 0.0)


class PixelCentres(mi.Sensor):  # type: ignore[misc]
    """The perspective camera `inside`, each of whose samples goes through its pixel's centre."""

    def __init__(self, props: Any) -> None:
        mi.Sensor.__init__(self, props)
        self.inside = props["inside"]

    def sample_ray_differential(
        self, time: Any, wavelength: Any, place: Any, aperture: Any, active: Any = True
    ) -> Any:
        size = mi.Vector2f(self.film().size())
        centre = (dr.floor(place * size) + 0.5) / size
        return self.inside.sample_ray_differential(time, wavelength, centre, aperture, active)

    def to_string(self) -> str:
        return "PixelCentres[]"


def register_plugins() -> None:
    """Let Mitsuba's scene dictionaries name these classes."""
    mi.register_bsdf("film_mirror", FilmMirror)
    mi.register_bsdf("rough_film", RoughFilm)
    mi.register_bsdf("film_pane", FilmPane)
    mi.register_sensor("pixel_centres", PixelCentres)
