"""What draws the pictures of `gltf-iri render`: OpenGL, or rays on the CPU."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from gltf_iri.cli.picture_options import EMPTY_PICTURE

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from gltf_iri.baking.baked import BakedTable
    from gltf_iri.baking.baked_layers import BakedLayers
    from gltf_iri.planning.material_plan import MaterialPlan
    from gltf_iri.planning.reach import Lobe
    from gltf_iri.rendering.frame import Frame
    from gltf_iri.scene.load import Model
    from gltf_iri.scene.model import Camera, Environment, Scene

__all__ = ["Brush", "Drawn", "opengl", "rays"]


@dataclass(frozen=True, slots=True)
class Brush:
    """What draws: a view's picture, how often a picture calls `advance`, and how it is put away."""

    draw: Callable[[Camera, Callable[[], None]], Frame]
    steps: int
    release: Callable[[], None] = lambda: None


def opengl(
    model: Model,
    scene: Scene,
    plans: Sequence[MaterialPlan],
    environment: Environment | None,
    size: tuple[int, int],
    tables: Mapping[int, Mapping[Lobe, BakedTable]],
    layer_tables: Mapping[int, BakedLayers],
) -> Brush:
    """Return OpenGL, one renderer for all pictures; MissingCapabilityError where there is none."""
    from gltf_iri.rendering.context import create_context
    from gltf_iri.rendering.render import Renderer

    context = create_context()
    renderer = Renderer(context)

    def draw(view: Camera, advance: Callable[[], None]) -> Frame:
        frame = renderer.render(
            model, scene, plans, view, environment, size=size, tables=tables, layer_tables=layer_tables
        )
        advance()
        return frame

    def release() -> None:
        renderer.release()
        context.release()

    return Brush(draw, 1, release)


def rays(
    model: Model,
    scene: Scene,
    plans: Sequence[MaterialPlan],
    environment: Environment | None,
    size: tuple[int, int],
    counts: Mapping[str, Any],
) -> Brush:
    """Return the CPU reference over its background; `counts` are arguments of `render_reference`."""
    import numpy as np

    from gltf_iri.reference.background import over_background
    from gltf_iri.reference.render import render_reference
    from gltf_iri.reference.tiles import count_tiles
    from gltf_iri.rendering.frame import Frame

    def draw(view: Camera, advance: Callable[[], None]) -> Frame:
        started = time.perf_counter()
        seen = render_reference(model, scene, plans, view, environment, size=size, advance=advance, **counts)
        rgba = over_background(seen.rgba, view, environment).astype(np.float32)
        return Frame(rgba, "the CPU reference", (time.perf_counter() - started) * 1000.0, seen.notes)

    return Brush(draw, count_tiles(size))


@dataclass
class Drawn:
    """Draws pictures as they are asked for, and adds up what is told about them."""

    draw: Callable[[Camera, Callable[[], None]], Frame]
    renderer: str = ""
    milliseconds: float = 0.0
    passes: dict[str, float] = field(default_factory=dict)  # milliseconds of each part
    notes: tuple[str, ...] = ()

    def pictures(self, views: Sequence[Camera], advance: Callable[[], None]) -> Iterator[NDArray[np.float32]]:
        """Yield the picture (height, width, 4) of each view, drawn when it is asked for."""
        is_empty = True
        for view in views:
            frame = self.draw(view, advance)
            self.renderer = frame.renderer
            self.milliseconds += frame.milliseconds
            for name, spent in frame.passes.items():
                self.passes[name] = self.passes.get(name, 0.0) + spent
            is_empty = is_empty and not frame.rgba[..., 3].any()
            empty = (EMPTY_PICTURE,) if is_empty and view is views[-1] else ()
            self.notes = tuple(dict.fromkeys((*self.notes, *frame.notes, *empty)))
            yield frame.rgba
