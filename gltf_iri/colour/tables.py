"""Where the colour tables come from: colour-science, written as CSV by `python -m gltf_iri.generate`.

At run time only the CSV files are read (`gltf_iri.colour.observer`), so that no command has to import
colour-science for a number.
"""

from __future__ import annotations

import warnings
from types import ModuleType
from typing import Final

__all__ = ["D65_FILE", "OBSERVER_FILE", "d65_csv", "import_colour_science", "observer_csv"]

OBSERVER_FILE: Final = "cie1931_2deg_1nm.csv"
D65_FILE: Final = "d65_5nm.csv"


def import_colour_science() -> ModuleType:
    """Import colour-science without its warning that SciPy is absent: nothing used here needs SciPy."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import colour
    return colour  # type: ignore[no-any-return]


def observer_csv() -> str:
    """Return the CIE 1931 2° colour matching functions, 360–830 nm in steps of 1 nm."""
    observer = import_colour_science().MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
    rows = [
        ",".join([f"{wavelength:g}", *(repr(float(value)) for value in values)])
        for wavelength, values in zip(observer.wavelengths, observer.values, strict=True)
    ]
    return _csv("wavelength_nm,x_bar,y_bar,z_bar", rows)


def d65_csv() -> str:
    """Return illuminant D65, 300–780 nm in steps of 5 nm."""
    d65 = import_colour_science().SDS_ILLUMINANTS["D65"]
    rows = [f"{w:g},{float(power)!r}" for w, power in zip(d65.wavelengths, d65.values, strict=True)]
    return _csv("wavelength_nm,relative_power", rows)


def _csv(header: str, rows: list[str]) -> str:
    return "\n".join([header, *rows, ""])
