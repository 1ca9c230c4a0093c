"""Where the colour tables come from: colour-science, written as CSV by `python -m gltf_iri.generate`.

At run time only the CSV files are read (`gltf_iri.colour.observer`), so that no command has to import
colour-science for a number.
"""

from __future__ import annotations

import warnings
from types import ModuleType
from typing import Final

__all__ = ["D65_FILE", "OBSERVER_FILE", "colour_tables", "import_colour_science"]

OBSERVER_FILE: Final = "cie1931_2deg_1nm.csv"
D65_FILE: Final = "d65_5nm.csv"


def import_colour_science() -> ModuleType:
    """Import colour-science without its warning that SciPy is absent: nothing used here needs SciPy."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import colour
    return colour  # type: ignore[no-any-return]


def colour_tables() -> dict[str, str]:
    """Return {path inside gltf_iri: text} of every colour table, as exported from colour-science."""
    colour = import_colour_science()
    observer = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
    d65 = colour.SDS_ILLUMINANTS["D65"]
    observer_rows = [
        ",".join([f"{wavelength:g}", *(repr(float(v)) for v in values)])
        for wavelength, values in zip(observer.wavelengths, observer.values, strict=True)
        if 360 <= wavelength <= 830
    ]
    d65_rows = [f"{w:g},{float(v)!r}" for w, v in zip(d65.wavelengths, d65.values, strict=True)]
    return {
        f"colour/data/{OBSERVER_FILE}": _csv("wavelength_nm,x_bar,y_bar,z_bar", observer_rows),
        f"colour/data/{D65_FILE}": _csv("wavelength_nm,relative_power", d65_rows),
    }


def _csv(header: str, rows: list[str]) -> str:
    return "\n".join([header, *rows, ""])
