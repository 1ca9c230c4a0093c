"""The image of a thickness texture: its steps, its channels, and its compression."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gltf_iri.validation.codes import issue
from gltf_iri.validation.rules.data_textures import LEVELS, VISIBLE_DELTA_E, image_of, lossy_format

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.iridescence.film import Film
    from gltf_iri.validation.issue import Issue

__all__ = ["Steps", "images_of"]

_CODES_BY_BITS = {8: "IRI_IRIDESCENCE_THICKNESS_BANDING", 16: "IRI_IRIDESCENCE_THICKNESS_16_BITS"}

# ΔE a nanometre of path difference, straight on: the worst of 1,500 random films, index 1.02 to 4, on any
# base is 2.87, and of 600 on bases of F0 up to 0.1, as dielectrics are, 1.44. Where a step is less than one
# over this no eye sees it, and numpy stays where it is.
_STEEPEST_PER_NM = 3.0
_STEEPEST_ON_DARK_PER_NM = 1.5
_DARK_F0 = 0.1
_STEEPEST_IOR = 4.0

# A millisecond each: what a file with more films than this asks for is not measured.
_MOST_MEASURED = 500


class Steps:
    """The largest ΔE of a step of 8 bits, measured once for each film of a file."""

    __slots__ = ("_known",)

    def __init__(self) -> None:
        self._known: dict[tuple[object, ...], float] = {}

    def of(self, film: Film) -> float:
        """Return the ΔE; 0 where no step can be seen, or too many films were measured."""
        step_nm = 2.0 * film.ior * (film.greatest_nm - film.least_nm) / (LEVELS - 1)
        is_dark = all(max(base.f0) <= _DARK_F0 for base in film.bases)
        steepest = _STEEPEST_ON_DARK_PER_NM if is_dark else _STEEPEST_PER_NM
        if film.ior <= _STEEPEST_IOR and step_nm * steepest < VISIBLE_DELTA_E:
            return 0.0
        bases = tuple((base.f0, base.is_known) for base in film.bases)
        key = (film.ior, film.minimum_nm, film.maximum_nm, bases)
        if key not in self._known:
            if len(self._known) == _MOST_MEASURED:
                return 0.0
            from gltf_iri.validation.optics.banding import largest_step

            self._known[key] = largest_step(film, LEVELS)
        return self._known[key]


def images_of(film: Film, asset: Asset, steps: Steps) -> Iterator[Issue]:
    """Yield what the image of the thickness texture means for the film."""
    info = film.thickness
    if info is None or (film.least_nm == film.greatest_nm and film.has_steady_thickness):
        return  # a texture that chooses nothing
    index = image_of(info, asset)
    image = asset.images.get(index) if index is not None else None
    if index is None or image is None or image.width * image.height == 1:
        return
    compression = lossy_format(image.media_type, asset.resources.image(index))
    if compression is not None:
        yield issue("IRI_IRIDESCENCE_THICKNESS_LOSSY", info.pointer, format=compression)
    if image.pixel_format in ("luminance", "luminance-alpha"):
        is_shared = film.strength is not None and film.strength.raw == info.raw
        code = "IRI_IRIDESCENCE_ONE_CHANNEL" if is_shared else "IRI_IRIDESCENCE_THICKNESS_GREY"
        yield issue(code, info.pointer)
    yield from _steps(film, image.bits, steps)


def _steps(film: Film, bits: int, steps: Steps) -> Iterator[Issue]:
    """Tell of steps that can be seen, straight away or once a reader has cut 16 bits to 8."""
    code = _CODES_BY_BITS.get(bits)
    if code is None or not film.has_steady_thickness:
        return
    delta_e = steps.of(film)
    if delta_e >= VISIBLE_DELTA_E:
        step_nm = (film.greatest_nm - film.least_nm) / (LEVELS - 1)
        yield issue(code, film.at("iridescenceThicknessTexture"), step=step_nm, delta_e=delta_e)
