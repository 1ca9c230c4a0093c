"""One file with its report, and what the formats ask about it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from gltf_iri.asset.guard import read_given
from gltf_iri.asset.limits import MAX_JSON_BYTES
from gltf_iri.errors import GltfIriError

if TYPE_CHECKING:
    from gltf_iri.validation.khronos import Verdict

__all__ = ["Judged"]

# Commas and opening brackets of a text whose lines are looked up: more of them take longer than a second.
_MOST_VALUES = 1_000_000


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
        pointers = [message.get("pointer") for message in self.messages]
        wanted = {pointer for pointer in pointers if pointer is not None}
        # A GLB's JSON has lines too, but nobody can open the file there.
        if not wanted or self.report.get("mimeType") != "model/gltf+json":
            return [None] * len(pointers)
        from gltf_iri.validation.reading.positions import lines_of

        try:
            data = read_given(Path(self.path), MAX_JSON_BYTES) if self.data is None else self.data
        except GltfIriError:  # gone since, or on another machine
            return [None] * len(pointers)
        if sum(map(data.count, (b",", b"[", b"{"))) > _MOST_VALUES:
            return [None] * len(pointers)
        known = lines_of(data, wanted)
        return [None if pointer is None else known.get(pointer) for pointer in pointers]
