"""One file with its report, and what the formats ask about it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gltf_iri.validation.khronos import Verdict

__all__ = ["Judged"]


class Judged:
    """A file that was checked.

    path : the file as it was named.
    report : its report in the Khronos validator's form.
    data : its bytes where they cannot be read again, as those of standard input.
    khronos : what the Khronos validator says of it, where it was asked.
    """

    __slots__ = ("data", "khronos", "path", "report")

    def __init__(
        self,
        path: str,
        report: dict[str, Any],
        *,
        data: bytes | None = None,
        khronos: Verdict | None = None,
    ) -> None:
        self.path = path
        self.report = report
        self.data = data
        self.khronos = khronos

    @property
    def messages(self) -> list[dict[str, Any]]:
        """The remarks, each with code, message, severity, and pointer or offset."""
        messages: list[dict[str, Any]] = self.report["issues"]["messages"]
        return messages

    @property
    def has_errors(self) -> bool:
        """Whether the file broke a rule, or could not be judged."""
        return bool(self.report["issues"]["numErrors"])

    def lines(self) -> list[int | None]:
        """Return for each remark the line of the .gltf file that it speaks of, None where there is none."""
        return [None] * len(self.messages)
