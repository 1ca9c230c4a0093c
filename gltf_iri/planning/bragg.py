"""Whether layers of Bragg mirrors are called for, and which of their textures."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Final

from gltf_iri.material.bragg import Bragg, MirrorLayer
from gltf_iri.material.bragg_limits import (
    BRAGG_CELLS_MAX,
    BRAGG_IOR_MAX,
    BRAGG_LAYERS_MAX,
    BRAGG_PERIOD_MAX_NM,
)
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import SPECULAR_GLOSSINESS, Material
from gltf_iri.planning.core import metal_verdict
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.reach import Span
from gltf_iri.planning.texels import texture_spans
from gltf_iri.planning.transmission import transmission_verdicts
from gltf_iri.planning.verdict import NotDrawn, Skip, Verdict, absent, texture_verdict

if TYPE_CHECKING:
    from gltf_iri.asset.document import Document

__all__ = ["bragg_verdicts", "layer_reflects", "period_texel", "verdicts_below"]

_EFFECTS: Final = (Effect.BRAGG, Effect.BRAGG_TEXTURE, Effect.BRAGG_PERIOD_TEXTURE)

# What shapes the reflection of the base's own surface, and nothing below it.
_OF_THE_SURFACE: Final = (
    *(Effect.SPECULAR, Effect.SPECULAR_TEXTURE, Effect.SPECULAR_COLOR_TEXTURE),
    *(Effect.ANISOTROPY, Effect.ANISOTROPY_TEXTURE),
)


def bragg_verdicts(material: Material, folded: Mapping[Effect, str]) -> Iterator[tuple[Effect, Verdict]]:
    """Yield the verdicts on the layers, on the texture of their factor and on that of their periods.

    folded : reasons for what `simplified` has taken out of `material`.
    """
    bragg = material.bragg
    if bragg is None:
        for effect in _EFFECTS:
            yield effect, absent(Bragg.EXTENSION)
        return
    layers = _idle(bragg) or _missing(material, bragg, folded)
    idle = None if layers is None else f"there are no layers: {layers.reason}"
    yield Effect.BRAGG, layers
    effect, everywhere = Effect.BRAGG_TEXTURE, "bragg texture: the factor holds everywhere"
    yield effect, texture_verdict(bragg.texture, everywhere, idle, folded.get(effect))
    if all(layer.period_min_nm == layer.period_max_nm for layer in bragg.layers):
        idle = idle or "minimum and maximum of every layer's period are the same, so it changes nothing"
    effect, everywhere = Effect.BRAGG_PERIOD_TEXTURE, "period texture: the maxima hold everywhere"
    yield effect, texture_verdict(bragg.period_texture, everywhere, idle, folded.get(effect))


def verdicts_below(material: Material, judged: Mapping[Effect, Verdict]) -> Iterator[tuple[Effect, Verdict]]:
    """Yield the verdicts that change where layers stand in place of the whole surface of `material`.

    judged : what the others said, of each effect.
    """
    is_whole = material.bragg is not None and material.bragg.factor == 1.0
    if is_whole and judged[Effect.BRAGG] is None and judged[Effect.BRAGG_TEXTURE] is not None:
        for effect in _OF_THE_SURFACE:
            if judged[effect] is None:
                yield effect, Skip("Bragg layers stand everywhere in place of the surface that it belongs to")


def layer_reflects(layer: MirrorLayer, bragg: Bragg) -> bool:
    """True where facets of `layer` mirror anything: an index differs, in a thickness above 0 if it is n2."""
    ior_1 = layer.first_ior(bragg.host_ior)
    if ior_1 != bragg.host_ior:
        return True
    has_films = layer.fill < 1.0 and max(_periods_nm(layer, bragg)) > 0.0
    return has_films and layer.ior_2 != ior_1


def period_texel(material: Material, document: Document | None) -> Span:
    """Return the values of the period texture, along which every layer's period runs; 1 without one.

    document : of the textures; None lets it hold all that it may.
    """
    (texel,) = texture_spans("bragg_period", material, document).channels
    return texel


def _periods_nm(layer: MirrorLayer, bragg: Bragg) -> tuple[float, ...]:
    """Return the ends that the period of `layer` runs between; without a texture the maximum holds."""
    if bragg.period_texture is None:
        return (layer.period_max_nm,)
    return layer.period_min_nm, layer.period_max_nm


def _idle(bragg: Bragg) -> Skip | None:
    if bragg.factor == 0.0:
        texture = ", and its texture can only multiply it" if bragg.texture else ""
        return Skip(f"the factor is 0{texture}")
    if not bragg.layers:
        return Skip("the list of layers is empty")
    return None


def _missing(material: Material, bragg: Bragg, folded: Mapping[Effect, str]) -> NotDrawn | None:
    if material.iridescence is not None:
        return NotDrawn(f"{Iridescence.EXTENSION} on the same material excludes it")
    if SPECULAR_GLOSSINESS in material.unread_extensions:
        return NotDrawn(f"{SPECULAR_GLOSSINESS} on the same material excludes it")
    if told := _beyond(bragg):
        return NotDrawn(f"{told} that are simulated")
    *above, last = (layer.first_ior(bragg.host_ior) != bragg.host_ior for layer in bragg.layers)
    if any(above):
        return NotDrawn("a first index that is not the host's bends light: only the last layer may have one")
    if not last:
        return None
    bends = "the last layer's first index is not the host's, and through it"
    if metal_verdict(material, folded) is None:
        return NotDrawn(f"{bends} no metal is drawn")
    if dict(transmission_verdicts(material, folded))[Effect.TRANSMISSION] is None:
        return NotDrawn(f"{bends} no light from behind is drawn")
    return None


def _beyond(bragg: Bragg) -> str:
    """Return what of `bragg` is more than is simulated; "" where nothing is."""
    if len(bragg.layers) > BRAGG_LAYERS_MAX:
        return f"{len(bragg.layers)} layers are more than the {BRAGG_LAYERS_MAX}"
    cells = max(layer.cells for layer in bragg.layers)
    if cells > BRAGG_CELLS_MAX:
        return f"{cells:g} cells are more than the {BRAGG_CELLS_MAX}"
    periods = [nm for layer in bragg.layers for nm in _periods_nm(layer, bragg)]
    if max(periods) > BRAGG_PERIOD_MAX_NM:
        return f"a period of {max(periods):g} nm is beyond the {BRAGG_PERIOD_MAX_NM:g} nm"
    of_films = [n for layer in bragg.layers for n in (layer.first_ior(1.0), layer.ior_2)]
    index = max(bragg.host_ior, *of_films)
    if index > BRAGG_IOR_MAX:
        return f"an index of {index:g} is beyond the indices up to {BRAGG_IOR_MAX:g}"
    return ""
