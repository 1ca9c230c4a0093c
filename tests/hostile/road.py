"""The whole road through a file without OpenGL, and what each file of a list costs on it.

As a program it measures: `python road.py <bytes> <seconds> FILE…` walks each file in a process of its own
that may take so many bytes of address space beyond those of the imports and so many seconds of processor
time, and prints one line of JSON a file. Linux only: sizes come from /proc.
"""

from __future__ import annotations

import json
import os
import resource
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import PIL.JpegImagePlugin
import PIL.PngImagePlugin
import PIL.WebPImagePlugin  # noqa: F401  # what Pillow would import while a case is measured

from gltf_iri.errors import GltfIriError
from gltf_iri.planning.decide import plan_materials
from gltf_iri.scene.choose import choose_camera
from gltf_iri.scene.load import load

PAGE = resource.getpagesize()


def walk(path: Path) -> tuple[list[str], str]:
    """Load, assemble, read each buffer, accessor, image and texture, plan; return notes and plans."""
    model = load(path)
    scene = model.scene()
    document = model.document
    for key, read in {
        "buffers": document.buffer,
        "accessors": document.accessor,
        "images": document.image,
        "textures": document.texture,
    }.items():
        for index in range(len(document.json.get(key, []))):
            read(index)
    choose_camera(scene, None, (16, 16))
    plans = [plan.to_json() for plan in plan_materials(model.materials, document=document, scene=scene)]
    notes = dict.fromkeys((*model.notes, *document.notes, *scene.notes))
    return list(notes), json.dumps(plans, ensure_ascii=False)


def cost(
    path: Path, most_bytes: int, most_seconds: int, walk: Callable[[Path], object] = walk
) -> dict[str, Any]:
    """Walk in a child process; return its end in a word, its seconds and by how many bytes it grew."""
    before = _pages(1) * PAGE
    child = os.fork()
    if child == 0:
        _walk_bounded(walk, path, _pages(0) * PAGE + most_bytes, most_seconds)
    _, status, used = os.wait4(child, 0)
    return {
        "file": path.name,
        "end": {0: "accepted", 1: "refused"}.get(os.waitstatus_to_exitcode(status), "broke down"),
        "seconds": used.ru_utime + used.ru_stime,
        "bytes": max(0, used.ru_maxrss * 1024 - before),
    }


def _walk_bounded(walk: Callable[[Path], object], path: Path, most_bytes: int, most_seconds: int) -> None:
    end = 2
    try:
        resource.setrlimit(resource.RLIMIT_AS, (most_bytes, most_bytes))
        resource.setrlimit(resource.RLIMIT_CPU, (most_seconds, most_seconds))
        walk(path)
        end = 0
    except GltfIriError:
        end = 1
    finally:
        os._exit(end)


def _pages(column: int) -> int:
    """Pages of address space (0) or memory (1) that this process has."""
    return int(Path("/proc/self/statm").read_text(encoding="ascii").split()[column])


def main() -> None:
    most_bytes, most_seconds, *paths = sys.argv[1:]
    for path in paths:
        print(json.dumps(cost(Path(path), int(most_bytes), int(most_seconds))))  # noqa: T201


if __name__ == "__main__":
    main()
