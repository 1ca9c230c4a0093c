"""``python -m gltf_iri`` and the ``gltf-iri`` script."""

from __future__ import annotations

import sys

from gltf_iri.cli.main import run

__all__ = ["main"]


def main() -> None:
    """Run the command line with this process's arguments and leave with its exit code."""
    sys.exit(run(sys.argv[1:]))


if __name__ == "__main__":
    main()
