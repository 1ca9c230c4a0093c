"""The gallery as one HTML file that needs nothing else, and as JSON."""

from __future__ import annotations

import base64
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from gltf_iri.comparison.report import what_is_judged
from gltf_iri.comparison.template import load_template
from gltf_iri.gallery.entry import Entry, Setup
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.whole_files import write_or_refuse

__all__ = ["gallery_html", "write_gallery"]


def write_gallery(entries: Sequence[Entry], setup: Setup, folder: Path) -> Path:
    """Write index.html into `folder` (made if missing) and return its path.

    Raises UsageError where it cannot be written there.
    """
    page = folder / "index.html"
    write_or_refuse({page: gallery_html(entries, setup).encode(errors="replace")})
    return page


def gallery_html(entries: Sequence[Entry], setup: Setup) -> str:
    """Return the page, pictures included as data URIs.

    Names in assets may hold markup: everything is escaped, and the page runs no script and loads nothing.
    """
    template = load_template(Path(__file__).parent / "templates" / "gallery.html.j2", _figure)
    return template.render(
        cards=[_card(entry) for entry in entries],
        size=setup.size,
        environment=setup.environment.name if setup.environment is not None else "none",
        sound=sum(entry.is_sound for entry in entries),
    )


def _card(entry: Entry) -> dict[str, Any]:
    """Return what the template shows: the file's materials summed up, and each of them."""
    told = entry.to_json()
    judged = [row["method_vs_truth"] for row in told["materials"] if row["method_vs_truth"] is not None]
    not_drawn = _counted(row["not_drawn"].items() for row in told["materials"])
    mentioned = (
        {e.value: why for e, why in plan.skipped.items() if e not in plan.absent} for plan in entry.plans
    )
    return {
        **told,
        "name": entry.file.name,
        "folder": str(entry.file.parent),
        "image": None if entry.picture is None else _data_uri(entry.picture),
        "effects": _counted((e.value for e in plan.effects) for plan in entry.plans),
        "methods": list(dict.fromkeys(filter(None, map(_method, entry.plans)))),
        "what": "" if entry.comparison is None else what_is_judged(entry.comparison),
        "judged": max(judged, key=lambda each: each["delta_e_mean"] or 0.0, default=None),
        "not_drawn": not_drawn,
        "left_out": _counted(row.items() for row in mentioned),
    }


def _method(plan: MaterialPlan) -> str | None:
    """Return by what the layers of a material or its film are drawn; None where it has neither."""
    if plan.layers is not None:
        return plan.layers.method
    return plan.method if plan.way is None or plan.method is None else plan.way.label


def _counted(rows: Iterable[Iterable[Any]]) -> Counter[Any]:
    """Return each thing with the number of materials that have it, in the order of its first one."""
    return Counter(thing for row in rows for thing in row)


def _data_uri(webp: bytes) -> str:
    return "data:image/webp;base64," + base64.b64encode(webp).decode()


def _figure(value: float | None) -> str:
    return "–" if value is None else f"{value:.2g}"
