"""One run of the validator over the files that a user named, in their order."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gltf_iri.asset.guard import read_given
from gltf_iri.asset.limits import MAX_FILE_BYTES
from gltf_iri.errors import AssetError, GltfIriError, UsageError
from gltf_iri.validation.find import STDIN
from gltf_iri.validation.formats.judged import Judged
from gltf_iri.validation.options import Options
from gltf_iri.validation.validate import validate

if TYPE_CHECKING:
    from gltf_iri.validation.khronos import KhronosValidator

__all__ = ["ask_khronos", "judge_files"]

Keep = Callable[[str], None]

_PIECE_BYTES = 2**20


def judge_files(
    files: Sequence[str],
    options: Options,
    *,
    jobs: int = 1,
    scheduler: str | None = None,
    keep: Keep | None = None,
) -> Iterator[Judged]:
    """Yield every file with its report, in the order of `files`; "-" is standard input.

    keep : is given each report as a line of JSON as soon as it is there, whatever its place in the order.

    Where there is one file alone, UsageError and AssetError are raised as by `validate`; among several they
    are remarks in the report of their file.
    """
    # By name, those that came before their turn.
    early: dict[str, Judged] = {}
    if STDIN in files:
        early[STDIN] = _judge_stdin(options, keep)
    others = [file for file in files if file != STDIN]
    stream: Iterable[Judged]
    if len(files) == 1 and scheduler is None:
        stream = (_judge_alone(file, options, keep) for file in others)
    else:
        stream = _judge_many(others, options, jobs, scheduler, keep)
    turn = iter(files)
    expected = next(turn, None)
    for judged in _after(early.get(STDIN), stream):
        early[judged.path] = judged
        while expected in early:
            yield early.pop(expected)
            expected = next(turn, None)


def ask_khronos(files: Iterable[Judged], validator: KhronosValidator, options: Options) -> Iterator[Judged]:
    """Yield the files with what the Khronos validator says of each."""
    from gltf_iri.validation.khronos import Verdict

    for file in files:
        folder = None if file.data is not None else Path(file.path).parent
        try:
            data = read_given(Path(file.path), MAX_FILE_BYTES) if file.data is None else file.data
        except GltfIriError as error:
            file.khronos = Verdict(None, f"it was not asked: {str(error).rstrip('.')}")
        else:
            file.khronos = validator.judge(data, file.path, folder, options)
        yield file


def _after(first: Judged | None, others: Iterable[Judged]) -> Iterator[Judged]:
    if first is not None:
        yield first
    yield from others


def _judge_alone(file: str, options: Options, keep: Keep | None) -> Judged:
    return _kept(Judged(file, validate(file, options=options).to_json()), keep)


def _judge_stdin(options: Options, keep: Keep | None) -> Judged:
    data = _read_stdin()
    report: dict[str, Any] = validate(data, uri=STDIN, options=options).to_json()
    return _kept(Judged(STDIN, report, data=data), keep)


def _read_stdin() -> bytes:
    if sys.stdin is None:
        raise UsageError("Standard input is closed: give the path of a file instead of '-'.")
    # Piece by piece: asking for the whole bound at once would reserve it.
    data = BytesIO()
    while piece := sys.stdin.buffer.read(_PIECE_BYTES):
        if data.tell() + len(piece) > MAX_FILE_BYTES:
            raise AssetError(f"standard input has more than the {MAX_FILE_BYTES} bytes allowed")
        data.write(piece)
    return data.getvalue()


def _kept(judged: Judged, keep: Keep | None) -> Judged:
    if keep is not None:
        import json

        keep(json.dumps(judged.report, allow_nan=False))
    return judged


def _judge_many(
    files: Sequence[str], options: Options, jobs: int, scheduler: str | None, keep: Keep | None
) -> Iterator[Judged]:
    from gltf_iri.validation.many.many import validate_many

    for result in validate_many(files, options, jobs=jobs, scheduler=scheduler):
        if keep is not None:
            keep(result.line)
        yield Judged(result.path, result.report)
