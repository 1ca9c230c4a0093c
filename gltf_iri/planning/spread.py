"""Whether the spread of a film's thickness within a pixel is called for."""

from __future__ import annotations

from gltf_iri.planning.method import Method
from gltf_iri.planning.reach import Reach
from gltf_iri.planning.verdict import NotDrawn, Skip, Verdict
from gltf_iri.planning.way import Way

__all__ = ["spread_verdict"]


def spread_verdict(texture: Verdict, method: Method, reach: Reach | None, way: Way | None) -> Verdict:
    """Judge the spread by the verdict on the thickness texture and by what computes the film.

    The sampler is not asked: a texture whose filter forbids smaller copies is averaged as well, for the
    colours of single thicknesses that flicker past are no look of the surface.
    """
    if isinstance(texture, NotDrawn):
        return Skip(f"the thickness texture is not drawn: {texture.reason}")
    if texture is not None:
        return texture
    if reach is not None and reach.thickness_nm.is_point:
        return Skip(f"the texture holds {reach.thickness_nm.low:g} nm everywhere")
    if way is not None and way.tables:
        if any(table.axis("spread_nm") for table in way.tables):
            return None
        return Skip("the table has no axis for it: it draws the mean thickness' colour")
    if method.glsl_spread_function is None:
        return Skip(f"{method.name} cannot average over thickness: it draws the mean thickness' colour")
    return None
