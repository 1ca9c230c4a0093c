"""Which loops do the numerical work: numpy always, compiled loops (numba) where they are installed.

Both give the same numbers to 1e-13; every result names the one that it came from.
"""

from __future__ import annotations

from functools import cache
from importlib.util import find_spec
from typing import Final, Literal

from gltf_iri.errors import MissingCapabilityError, UsageError

__all__ = ["BACKENDS", "Backend", "choose_backend", "has_numba"]

Backend = Literal["numpy", "numba"]

BACKENDS: Final = ("auto", "numpy", "numba")

# Loading compiled loops takes about as long as numpy takes for so many colours.
_WORTH_COMPILING: Final = 20_000


@cache
def has_numba() -> bool:
    """Return whether compiled loops can be had, without importing them."""
    return find_spec("numba") is not None


def choose_backend(wanted: str, count: int, available: tuple[Backend, ...], method: str) -> Backend:
    """Return the backend for `count` colours by `method`, which has those `available`.

    "auto" takes numba where it is installed, the method has it and the colours are many. Raises UsageError
    for an unknown backend or one that the method does not have, MissingCapabilityError without numba.
    """
    if wanted not in BACKENDS:
        raise UsageError(f"There is no backend '{wanted}'; choose one of: {', '.join(BACKENDS)}.")
    if wanted == "numpy":
        return "numpy"
    if wanted == "auto":
        pays = count >= _WORTH_COMPILING and "numba" in available and has_numba()
        return "numba" if pays else "numpy"
    if "numba" not in available:
        raise UsageError(f"The method '{method}' has no compiled loops: leave the backend to auto or numpy.")
    if not has_numba():
        raise MissingCapabilityError(
            "Compiled loops need numba, which is not installed: pip install 'gltf-iri[fast]'."
        )
    return "numba"
