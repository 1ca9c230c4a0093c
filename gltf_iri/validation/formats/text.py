"""Reports for people: a line for each sound file, the remarks below each other file, and the sum."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any

from gltf_iri.asset.words import printable
from gltf_iri.validation.formats.judged import Judged
from gltf_iri.validation.issue import SEVERITY_NAMES

__all__ = ["written"]

_COUNT_NAMES = ("numErrors", "numWarnings", "numInfos", "numHints")
_NOUNS = (("error", "errors"), ("warning", "warnings"), ("information",) * 2, ("hint", "hints"))

# ANSI: red, yellow, cyan, grey; bold for names.
_COLOURS = ("31", "33", "36", "90")
_BOLD, _GREEN = "1", "32"


def written(files: Iterable[Judged], *, is_coloured: bool = False) -> Iterator[str]:
    """Yield the text file by file; the sums follow where there are several."""
    paint = _painted if is_coloured else _plain
    sums = [0] * len(_COUNT_NAMES)
    total = unsound = asked = agreed = 0
    for file in files:
        total += 1
        counts = [file.report["issues"][name] for name in _COUNT_NAMES]
        sums = [so_far + count for so_far, count in zip(sums, counts, strict=True)]
        unsound += file.has_errors
        name = paint(printable(file.path), _BOLD)
        if file.messages:
            yield f"{name}: {_counted(counts)}\n"
            yield from _remarks(file, paint)
        else:
            yield f"{name}: {paint('no remarks', _GREEN)}\n"
        if file.khronos is not None:
            asked += 1
            agreed += file.khronos.agrees(file.report)
            yield from file.khronos.lines(file.report)
    if total > 1:
        yield f"{total} files, {unsound} with errors: {_counted(sums)}.\n"
        if asked:
            yield f"Khronos agrees on {agreed} of {asked} whether there are errors.\n"


def _counted(counts: Iterable[int]) -> str:
    """Return counts by severity as words, without those of nothing."""
    told = [f"{count} {nouns[count != 1]}" for count, nouns in zip(counts, _NOUNS, strict=True) if count]
    return ", ".join(told) or "no remarks"


def _remarks(file: Judged, paint: Callable[[str, str], str]) -> Iterator[str]:
    width = max(len(SEVERITY_NAMES[message["severity"]]) for message in file.messages)
    for message, line in zip(file.messages, file.lines(), strict=True):
        severity = message["severity"]
        word = paint(SEVERITY_NAMES[severity].ljust(width), _COLOURS[severity])
        place = _place(message, line)
        yield f"  {word}  {paint(printable(message['code']), _BOLD)}{place and f'  {place}'}\n"
        yield f"  {'':{width}}  {printable(message['message'])}\n"
    if file.report["issues"]["truncated"]:
        yield "  There are more remarks than these (--max-issues 0 tells all).\n"


def _place(message: dict[str, Any], line: int | None) -> str:
    if "offset" in message:
        return f"byte {message['offset']}"
    pointer = printable(message.get("pointer", ""))
    return pointer if line is None else f"{pointer or '/'}  line {line}"


def _plain(text: str, _: str) -> str:
    return text


def _painted(text: str, style: str) -> str:
    return f"\x1b[{style}m{text}\x1b[0m"
