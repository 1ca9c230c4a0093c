"""The GLSL that the text of EXT_materials_bragg prints compiles, and computes what its formulas say."""

from __future__ import annotations

import re
from pathlib import Path

import moderngl
import numpy as np
import pytest
from single_precision import rounded

from gltf_iri.optics.bragg import bragg_reflectance
from gltf_iri.optics.rough_bragg import transmission_filter
from gltf_iri.rendering.probe import Probe

pytestmark = pytest.mark.gl

README = Path(__file__).resolve().parents[2] / "spec" / "EXT_materials_bragg" / "README.md"
ROWS = 4000
CALL = (
    "float called(vec3 n, vec3 d, vec3 at) {",
    "    return bragg_reflectance(n.x, n.y, n.z, d.x, d.y, int(d.z), at.x, at.y);",
    "}",
)


def printed(function: str) -> str:
    """Return the block of GLSL that states `function`."""
    blocks = re.findall(r"```glsl\n(.*?)```", README.read_text(encoding="utf-8"), flags=re.DOTALL)
    (found,) = [block for block in blocks if f" {function}(" in block]
    return found


def lines_of(function: str) -> list[str]:
    # The probe's own include brings π.
    return [line for line in printed(function).splitlines() if not line.startswith("const float PI")]


def test_printed_closed_form_is_the_reflectance(probe: Probe) -> None:
    """In air and in hosts, with a step to ior1 and without, also where light fades in either film."""
    g = np.random.default_rng(31)
    host = np.where(g.random(ROWS) < 0.5, 1.0, g.uniform(1.0, 1.8, ROWS))
    n1 = np.where(g.random(ROWS) < 0.5, host, g.uniform(1.0, 1.8, ROWS))
    films = [rounded(x) for x in (host, n1, g.uniform(1.0, 2.4, ROWS))]
    cells = [rounded(g.uniform(0.0, 400.0, ROWS)) for _ in range(2)] + [g.integers(1, 8, ROWS).astype(float)]
    nm, cosine = rounded(g.uniform(380.0, 780.0, ROWS)), rounded(g.uniform(0.05, 1.0, ROWS))
    expected = bragg_reflectance(*films, *cells, nm, cosine)
    arguments = [np.stack(films, -1), np.stack(cells, -1), np.stack([nm, cosine, nm], -1)]
    found = probe.call(
        "called", "common/math.glsl", arguments, "float", lines=[*lines_of("bragg_reflectance"), *CALL]
    )
    # What float32 makes of phases of some ten radians, and of q next to total reflection.
    assert np.abs(found - expected).max() < 2e-5


def test_printed_closed_form_survives_a_thousand_cells(probe: Probe) -> None:
    g = np.random.default_rng(32)
    nm, cosine = rounded(g.uniform(380.0, 780.0, ROWS)), rounded(g.uniform(0.001, 1.0, ROWS))
    films = np.broadcast_to([1.0, 1.0, 4.0], (ROWS, 3))
    cells = np.stack([g.uniform(0.0, 5e3, ROWS), g.uniform(0.0, 5e3, ROWS), np.full(ROWS, 1000.0)], -1)
    arguments = [films, cells, np.stack([nm, cosine, nm], -1)]
    found = probe.call(
        "called", "common/math.glsl", arguments, "float", lines=[*lines_of("bragg_reflectance"), *CALL]
    )
    assert np.all((found >= 0.0) & (found <= 1.0))


def test_printed_filter_is_the_filter(probe: Probe) -> None:
    g = np.random.default_rng(33)
    alpha = rounded(g.uniform(0.05, 1.0, ROWS))
    theta, met = (rounded(g.uniform(0.01, 1.5, ROWS)) for _ in range(2))
    expected = transmission_filter(np.cos(theta), met, alpha)
    found = probe.call(
        "transmission_filter",
        "common/math.glsl",
        [theta, met, alpha],
        "float",
        lines=lines_of("transmission_filter"),
    )
    assert np.max(np.abs(found - expected) / np.maximum(1.0, expected)) < 5e-6


def test_printed_look_up_compiles(gl_context: moderngl.Context) -> None:
    fragment = f"""#version 330
    {printed("stack_colour").replace("#define", chr(10) + "#define")}
    out vec3 colour;
    void main() {{ colour = stack_colour(1, 2, 0.5, 0.6, 0.7, 0.25); }}
    """
    vertex = "#version 330\nvoid main() { gl_Position = vec4(0.0); }"
    program = gl_context.program(vertex_shader=vertex, fragment_shader=fragment)
    assert {"u_reflected", "u_transmitted", "u_band_rgb"} <= set(program)
    program.release()
