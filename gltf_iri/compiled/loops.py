"""How loops are compiled, the same for all."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, TypeVar, cast

from gltf_iri.errors import MissingCapabilityError

try:
    import numba
    from numba.core.codegen import get_host_cpu_features
except (ImportError, OSError) as error:  # numba refuses a numpy that is newer than it, and LLVM may not load
    raise MissingCapabilityError(
        f"Compiled loops do not load ({error}): install numba anew, or take the backend numpy."
    ) from error

__all__ = ["as_written", "inline", "loop"]

Function = TypeVar("Function", bound=Callable[..., Any])

# Python's check for a zero divisor keeps the compiler from using vector instructions; numpy's rules (∞, NaN)
# do not. Of the liberties with floating point only fused multiply-add is taken: sums keep their order.
# Loops touch their arrays only, so that Python's other threads may run meanwhile.
_OPTIONS: dict[str, Any] = {"error_model": "numpy", "fastmath": {"contract"}, "nogil": True}


def loop(function: Function) -> Function:
    """Compile a function that runs over arrays; its machine code is kept on disk for the next start."""
    chosen = numba.config.CACHE_DIR
    numba.config.CACHE_DIR = _kept_in(chosen)
    try:
        return cast(Function, numba.njit(cache=True, **_OPTIONS)(function))
    except RuntimeError:  # no folder for it can be written: compile anew at each start
        return cast(Function, numba.njit(**_OPTIONS)(function))
    finally:
        numba.config.CACHE_DIR = chosen


@cache
def _kept_in(chosen: str) -> str:
    """Return a folder for machine code, within the user's `chosen` one, that no other state of this one has.

    By itself numba compiles a loop anew where its own file has changed, but not where another has that it
    inlines: after an upgrade, or an edit, it would go on with the old numbers.
    """
    here = Path(__file__).parent
    sources = hashlib.sha256()
    for file in sorted(here.glob("*.py")):
        sources.update(file.read_bytes())
    return str(Path(chosen or here / "__pycache__") / f"loops-{sources.hexdigest()[:16]}")


def inline(function: Function) -> Function:
    """Compile a scalar function into the loops that call it."""
    return cast(Function, numba.njit(inline="always", **_OPTIONS)(function))


def as_written(function: Function) -> Function:
    """Compile a scalar function whose rounding errors are known: no multiplication fuses with a sum."""
    return cast(Function, numba.njit(error_model="numpy")(function))


def _use_whole_vectors() -> None:
    """Let AVX-512 hosts use all of it, which LLVM by default does not: polynomials gain a third of the time.

    The setting is numba's own (NUMBA_CPU_FEATURES) and changes nothing once anything has been compiled; what
    a user has set stays.
    """
    is_free = numba.config.CPU_NAME is None and numba.config.CPU_FEATURES is None
    features = get_host_cpu_features()
    if is_free and "+avx512f" in features.split(","):
        numba.config.CPU_FEATURES = features + ",-prefer-256-bit"


_use_whole_vectors()
