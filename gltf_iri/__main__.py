"""``python -m gltf_iri`` and the ``gltf-iri`` script."""

from __future__ import annotations

import signal
import sys

from gltf_iri.cli.door import run

__all__ = ["main"]


def main() -> None:
    """Run the command line with this process's arguments and leave with its exit code."""
    # Not ended on the spot, as is the default: what is half-written is taken away first.
    for name in ("SIGTERM", "SIGHUP"):
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), _leave)
    sys.exit(run(sys.argv[1:]))


def _leave(number: int, _: object) -> None:
    sys.exit(128 + number)


if __name__ == "__main__":
    main()
