"""Reports as JSON: an object for one file, a line for each of several."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator

from gltf_iri.validation.formats.judged import Judged

__all__ = ["written"]


def written(files: Iterable[Judged], *, is_indented: bool = False) -> Iterator[str]:
    """Yield the reports; what the Khronos validator said stands under "khronos"."""
    for file in files:
        report = file.report
        if file.khronos is not None:
            report = {**report, "khronos": file.khronos.to_json(report)}
        # ASCII: a lone surrogate in a name must not break the stream that it is written to.
        yield json.dumps(report, indent=2 if is_indented else None, allow_nan=False) + "\n"
