"""Breaks real assets at random and walks the road through them, for as long as it is told to.

`python tests/hostile/fuzz.py MINUTES FOLDER… [--seed N] [--keep FOLDER]` reads every .gltf and .glb below the
folders, with the files beside it. Every broken file must end in one sentence that says where, or be accepted;
some of the accepted ones are drawn. A traceback, more than three seconds of work, or a process that keeps
growing is a finding: its file is kept, and the exit code is 1. Linux only: sizes come from /proc.
"""

from __future__ import annotations

import argparse
import collections
import random
import shutil
import signal
import sys
import tempfile
import time
import traceback
import warnings
from pathlib import Path

from road import walk
from victims import assets, breakage, resident, ring

from gltf_iri.errors import AssetError
from gltf_iri.planning.decide import plan_materials
from gltf_iri.rendering.context import create_context
from gltf_iri.rendering.render import Renderer
from gltf_iri.scene.choose import choose_camera
from gltf_iri.scene.environment import white
from gltf_iri.scene.load import load
from gltf_iri.scene.model import Environment

LONGEST_SENTENCE = 300
MOST_SECONDS = 3.0
HANG_SECONDS = 20
SHARE_DRAWN = 0.08
# Caches and the driver's compiler settle; what the process holds later than this may not grow for good.
SETTLED = 0.25
MOST_GROWTH = 150 * 2**20  # bytes


def draw(renderer: Renderer, path: Path, environment: Environment) -> None:
    """Draw the file small."""
    model = load(path)
    scene = model.scene()
    camera = choose_camera(scene, None, (8, 8))
    plans = plan_materials(model.materials, document=model.document, scene=scene)
    renderer.render(model, scene, plans, camera, environment, size=(8, 8), samples=0)


def trial(path: Path, renderer: Renderer, environment: Environment | None) -> tuple[str, str]:
    """Return what became of the file in a word, and for a finding what is wrong ("" for none).

    environment : what an accepted file is drawn under; None for not drawn.
    """
    started = time.process_time()
    seconds = 0.0
    signal.alarm(HANG_SECONDS)
    try:
        walk(path)
        # Without drawing: how long compiling takes is up to the driver and to how many materials there are.
        seconds = time.process_time() - started
        if environment is not None:
            draw(renderer, path, environment)
        end, finding = "accepted", ""
    except AssetError as error:
        is_placed = error.pointer is not None or error.offset is not None
        is_sentence = len(error.what) <= LONGEST_SENTENCE and str(error).isprintable()
        end, finding = "refused", "" if is_placed and is_sentence else f"no sentence or no place: {error}"
    except BaseException:  # whatever comes out is what is looked for
        end, finding = "broke down", traceback.format_exc(limit=-4)
    finally:
        signal.alarm(0)
    seconds = seconds or time.process_time() - started
    if not finding and seconds > MOST_SECONDS:
        finding = f"took {seconds:.1f} s"
    return end, finding


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("minutes", type=float)
    parser.add_argument("folders", type=Path, nargs="+")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--keep", type=Path, default=Path("fuzz-findings"))
    asked = parser.parse_args()
    warnings.simplefilter("error")
    signal.signal(signal.SIGALRM, ring)
    chance, renderer, sky = random.Random(asked.seed), Renderer(create_context()), white()
    files = assets(asked.folders)
    counts: collections.Counter[str] = collections.Counter()
    started, settled, held = time.monotonic(), 0, 0
    while (passed := (time.monotonic() - started) / 60.0) < asked.minutes:
        with tempfile.TemporaryDirectory() as folder:
            path = breakage(chance.choice(files), Path(folder), chance)
            end, finding = trial(path, renderer, sky if chance.random() < SHARE_DRAWN else None)
            counts[end] += 1
            if finding:
                kept = asked.keep / str(counts.total())
                shutil.copytree(folder, kept)
                counts["findings"] += 1
                print(f"{kept / path.name}: {finding}", flush=True)  # noqa: T201
        held = resident()
        if passed < SETTLED * asked.minutes:
            settled = max(settled, held)
    grown = held - settled
    counts["findings"] += grown > MOST_GROWTH
    print(f"{len(files)} assets, {dict(counts)}, grown by {grown / 2**20:.0f} MiB")  # noqa: T201
    return 1 if counts["findings"] else 0


if __name__ == "__main__":
    sys.exit(main())
