"""One remark about a file: what is wrong, how bad it is, and where it stands."""

from __future__ import annotations

from collections import namedtuple
from typing import TYPE_CHECKING

__all__ = ["ERROR", "HINT", "INFORMATION", "SEVERITIES", "SEVERITY_NAMES", "WARNING", "Issue"]

# The numbers of the Khronos report format. Plain integers: an Enum costs more at start than all rules.
ERROR, WARNING, INFORMATION, HINT = SEVERITIES = (0, 1, 2, 3)
SEVERITY_NAMES = ("error", "warning", "information", "hint")

if TYPE_CHECKING:
    from typing import NamedTuple

    class Issue(NamedTuple):
        """A remark: its code, a sentence, the severity, and a JSON Pointer or a byte offset into a GLB."""

        code: str
        message: str
        severity: int
        pointer: str | None = None
        offset: int | None = None

else:
    Issue = namedtuple("Issue", "code message severity pointer offset", defaults=(None, None))
