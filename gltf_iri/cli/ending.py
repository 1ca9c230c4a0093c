"""How every run ends: with an exit code, and where it failed with one sentence on stderr.

Nothing here needs click, so that a call that goes without it ends in the same way.
"""

from __future__ import annotations

import io
import os
import sys
from collections.abc import Callable
from pathlib import Path

from gltf_iri.asset.words import printable
from gltf_iri.errors import GltfIriError

__all__ = ["PROGRAM", "ended", "fail", "flushed"]

PROGRAM = "gltf-iri"
PACKAGE = "gltf_iri"

# What shells report for a program that a signal ended: 128 + SIGINT and 128 + SIGPIPE.
_INTERRUPTED = 130
_READER_LEFT = 141


def ended(work: Callable[[], int]) -> int:
    """Do the work and return its exit code; every expected failure becomes one line on stderr."""
    _open_closed_streams()
    if isinstance(sys.stdout, io.TextIOWrapper):
        # A terminal or pipe without λ or é shows an escape instead; a traceback would lose the result.
        sys.stdout.reconfigure(errors="backslashreplace")
    try:
        return flushed(work())
    except GltfIriError as error:
        return fail(str(error), error.exit_code)
    except KeyboardInterrupt:
        return fail("Interrupted.", _INTERRUPTED)
    except BrokenPipeError:
        return _reader_left()
    except OSError as error:
        return fail(_system_sentence(error), 2)
    except ImportError as error:
        if (error.name or PACKAGE).partition(".")[0] == PACKAGE:
            raise  # ours: a bug
        return fail(f"A package does not load ({error}); install {PROGRAM} anew with pip.", 3)
    except MemoryError:
        return fail("The machine has too little memory for this: ask for a smaller picture.", 3)


def fail(sentence: str, exit_code: int) -> int:
    """Tell what failed, and return the exit code for it."""
    try:
        sys.stderr.write(f"{PROGRAM}: {printable(sentence)}\n")
        sys.stderr.flush()
    except BrokenPipeError:
        return _reader_left()
    return exit_code


def flushed(exit_code: int) -> int:
    """Return the exit code once stdout is written out: a reader who left is noticed here, not at shutdown."""
    try:
        sys.stdout.flush()
    except BrokenPipeError:
        return _reader_left()
    return exit_code


def _open_closed_streams() -> None:
    """Let a caller close stdout or stderr (`>&-`): what goes there is lost, the work is done all the same."""
    # Python leaves None in the place of such a stream, and the next file opened would get its number.
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, Path(os.devnull).open("w"))  # noqa: SIM115  # for the life of the process


def _reader_left() -> int:
    """End without a message: in `gltf-iri … | head` it is normal that the reader stops early."""
    # The interpreter flushes stdout once more as it ends and would complain about the closed pipe.
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return _READER_LEFT


def _system_sentence(error: OSError) -> str:
    reason = error.strerror or str(error)
    return f"{error.filename}: {reason}." if error.filename else f"{reason}."
