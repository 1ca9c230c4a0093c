"""Writes a comparison: pictures, report.json (spec/report.schema.json) and one self-contained HTML page."""

from __future__ import annotations

import base64
import json
import math
import os
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.comparison.figures import delta_e_map, deviation_map
from gltf_iri.comparison.result import Comparison
from gltf_iri.rendering.picture import write_picture

__all__ = ["report_html", "write_report"]

_TONEMAP = "neutral"


def write_report(comparison: Comparison, folder: Path, *, exposure: float) -> dict[str, Path]:
    """Write every file of the report into `folder` (made if missing) and return their paths by name.

    Each file appears whole or not at all. `exposure` is the pictures', as `write_picture` takes it.
    """
    folder.mkdir(parents=True, exist_ok=True)
    pictures, paths = comparison.pictures, {}
    for name, linear in (("glsl", pictures.glsl), ("python", pictures.python), ("truth", pictures.truth)):
        paths[name] = folder / f"{name}.png"
        write_picture(paths[name], _with_alpha(linear, pictures.drawn), exposure, _TONEMAP)
    maps = {
        "difference_glsl_python": deviation_map(pictures.deviation, pictures.drawn),
        "difference_method_truth": delta_e_map(pictures.delta_e, pictures.drawn),
    }
    if pictures.texture_delta_e is not None:
        maps["difference_8bit_textures"] = delta_e_map(pictures.texture_delta_e, pictures.drawn)
    for name, data in maps.items():
        paths[name] = _replace(folder / f"{name}.png", data)
    report = json.dumps(_strict(comparison.to_json()), indent=2, ensure_ascii=False, allow_nan=False)
    images = {name: path.read_bytes() for name, path in paths.items()}
    paths["report"] = _replace(folder / "report.json", (report + "\n").encode())
    paths["page"] = _replace(folder / "index.html", report_html(comparison, images).encode())
    return paths


def report_html(comparison: Comparison, images: dict[str, bytes]) -> str:
    """Return the page; `images` maps names of `write_report` to PNG bytes, which it carries as data URIs.

    Names in assets come from strangers: everything is escaped, and the page runs no script and loads nothing.
    """
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    templates = Environment(
        loader=FileSystemLoader(Path(__file__).parent / "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    templates.filters["figure"] = _figure
    uris = {name: "data:image/png;base64," + base64.b64encode(data).decode() for name, data in images.items()}
    return templates.get_template("report.html.j2").render(report=comparison.to_json(), images=uris)


def _figure(value: float | None) -> str:
    """Three significant digits for people; a dash where there is nothing to measure."""
    if value is None:
        return "–"
    if value == 0.0 or 1e-3 <= abs(value) < 1e4:
        return f"{value:.3g}"
    mantissa, exponent = f"{value:.1e}".split("e")
    return f"{mantissa}·10{str(int(exponent)).translate(str.maketrans('-0123456789', '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'))}"


def _with_alpha(linear: NDArray[np.float64], drawn: NDArray[np.bool_]) -> NDArray[np.float32]:
    return np.concatenate([linear, drawn[..., None]], axis=-1).astype(np.float32)


def _strict(value: Any) -> Any:
    """Return `value` with infinities and NaN as null, which is all that JSON has for them."""
    if isinstance(value, dict):
        return {key: _strict(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_strict(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _replace(path: Path, data: bytes) -> Path:
    """Write beside `path`, then rename, so that a reader never sees half a file."""
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(data)
        Path(name).chmod(0o644)  # mkstemp keeps others out; a report is for everyone
        Path(name).replace(path)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise
    return path
