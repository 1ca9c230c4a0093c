"""How much memory of its own the process holds, apart from the files that it has mapped."""

from __future__ import annotations

from pathlib import Path
from typing import Final

__all__ = ["PeakMemory"]

_STATUS: Final = Path("/proc/self/status")
_ANONYMOUS: Final = "RssAnon:"


class PeakMemory:
    """The most anonymous memory that `sample` has met, in bytes; None where the system does not tell."""

    def __init__(self) -> None:
        self.bytes: int | None = None
        self.sample()

    def sample(self) -> None:
        """Look once; a few microseconds."""
        if not _STATUS.exists():
            return
        for line in _STATUS.read_text(encoding="ascii", errors="replace").splitlines():
            if line.startswith(_ANONYMOUS):
                held = int(line.split()[1]) * 1024  # Linux tells kibibytes
                self.bytes = held if self.bytes is None else max(self.bytes, held)
