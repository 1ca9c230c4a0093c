"""Writes a comparison: pictures, report.json (spec/report.schema.json) and one self-contained HTML page."""

from __future__ import annotations

import base64
import json
import math
from pathlib import Path
from typing import Any

from gltf_iri.comparison.figures import delta_e_map, deviation_map, picture
from gltf_iri.comparison.result import Comparison
from gltf_iri.comparison.template import load_template
from gltf_iri.whole_files import write_or_refuse

__all__ = ["report_html", "what_is_judged", "write_report"]


def write_report(comparison: Comparison, folder: Path) -> dict[str, Path]:
    """Write every file of the report into `folder` (made if missing) and return their paths by name.

    All files appear, each of them whole, or none does. Raises UsageError where the folder is not writable.
    """
    images = _images(comparison)
    report = json.dumps(_strict(comparison.to_json()), indent=2, ensure_ascii=False, allow_nan=False)
    files = {name: (f"{name}.png", data) for name, data in images.items()}
    # A file's name need not be UTF-8. Its stray bytes stay readable in JSON, whose escapes these are.
    files["report"] = ("report.json", f"{report}\n".encode(errors="backslashreplace"))
    files["page"] = ("index.html", report_html(comparison, images).encode(errors="replace"))
    write_or_refuse({folder / file: data for file, data in files.values()}, folder)
    return {name: folder / file for name, (file, _) in files.items()}


def _images(comparison: Comparison) -> dict[str, bytes]:
    shown, exposure = comparison.pictures, float(comparison.setup["exposure"])
    images = {
        "glsl": picture(shown.glsl, shown.drawn, exposure),
        "python": picture(shown.python, shown.drawn, exposure),
        "truth": picture(shown.truth, shown.drawn, exposure),
        "difference_glsl_python": deviation_map(shown.deviation, shown.drawn),
        "difference_method_truth": delta_e_map(shown.delta_e, shown.drawn),
    }
    if shown.texture_delta_e is not None:
        images["difference_8bit_textures"] = delta_e_map(shown.texture_delta_e, shown.drawn)
    held = comparison.reference
    if held is not None:
        images["drawn"] = picture(held.glsl, held.drawn, exposure)
        images["reference"] = picture(held.picture, held.drawn, exposure)
        images["difference_reference"] = delta_e_map(held.delta_e, held.drawn)
    return images


def report_html(comparison: Comparison, images: dict[str, bytes]) -> str:
    """Return the page; `images` maps names of `write_report` to PNG bytes, which it carries as data URIs.

    Names in assets may hold markup: everything is escaped, and the page runs no script and loads nothing.
    """
    template = load_template(Path(__file__).parent / "templates" / "report.html.j2", _figure)
    uris = {name: "data:image/png;base64," + base64.b64encode(data).decode() for name, data in images.items()}
    what = what_is_judged(comparison)
    return template.render(
        report=comparison.to_json(),
        images=uris,
        what=what,
        nothing=f"no {what}",
        whites={
            m.plan.method if m.plan.layers is None else m.plan.layers.method: m.method_white
            for m in comparison.materials
            if m.method_white is not None
        },
        # What the file does not even mention stays in the JSON; people want what was decided against.
        left_out=[
            {effect.value: reason for effect, reason in m.plan.skipped.items() if effect not in m.plan.absent}
            for m in comparison.materials
        ],
    )


def what_is_judged(comparison: Comparison) -> str:
    """Return what of the materials is held against truth: films, Bragg layers, or both."""
    plans = [material.plan for material in comparison.materials]
    if all(plan.layers is None for plan in plans):
        return "film"
    return "layers" if all(plan.method is None for plan in plans) else "film or layers"


def _figure(value: float | None) -> str:
    """Three significant digits for people; a dash where there is nothing to measure."""
    if value is None:
        return "–"
    if value == 0.0 or 1e-3 <= abs(value) < 1e4:
        return f"{value:.3g}"
    mantissa, exponent = f"{value:.1e}".split("e")
    return f"{mantissa}·10{str(int(exponent)).translate(str.maketrans('-0123456789', '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'))}"


def _strict(value: Any) -> Any:
    """Return `value` with infinities and NaN as null, which is all that JSON has for them."""
    if isinstance(value, dict):
        return {key: _strict(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_strict(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
