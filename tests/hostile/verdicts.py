"""What a verdict on each file of a list costs: as `road.py`, with the validator in the place of the road."""

from __future__ import annotations

import json
import sys
from pathlib import Path

from road import cost

from gltf_iri.validation.validate import validate


def judge(path: Path) -> None:
    """Make the report, as it would be written."""
    validate(path).to_json()


def main() -> None:
    most_bytes, most_seconds, *paths = sys.argv[1:]
    for path in paths:
        print(json.dumps(cost(Path(path), int(most_bytes), int(most_seconds), judge)))  # noqa: T201


if __name__ == "__main__":
    main()
