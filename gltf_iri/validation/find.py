"""Which files are meant: names, folders and all in them, and patterns that the shell left alone."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterable
from pathlib import Path

from gltf_iri.errors import UsageError

__all__ = ["STDIN", "Found", "find_files"]

# What stands for standard input on the command line, and names it in reports.
STDIN = "-"

_ENDINGS = (".gltf", ".glb")
_MAGIC = "*?["
# Of what a sentence repeats.
_LONGEST = 300


class Found:
    """The files to check, as they are to be named, and what was passed over, with the reason."""

    __slots__ = ("files", "passed_over")

    def __init__(self) -> None:
        self.files: list[str] = []
        self.passed_over: list[str] = []


def find_files(given: Iterable[str]) -> Found:
    """Return the files that `given` means, in its order and sorted within folders, none of them twice.

    A folder means the .gltf and .glb files in it and in the folders below; folders behind links are not
    entered, so no walk is without end. A name that does not exist and has `*`, `?` or `[` is a pattern, `**`
    any number of folders. Raises UsageError for what does not exist or is neither a file nor a folder, and
    where there is nothing to check.
    """
    names = tuple(given)
    search = _Search()
    for name in names:
        search.take(name)
    if not search.found.files:
        raise UsageError(f"There is no .gltf or .glb file in {_short(', '.join(names))}.")
    return search.found


class _Search:
    """One search: what was found, and which files and folders were met already, by their true places."""

    def __init__(self) -> None:
        self.found = Found()
        self._files: set[str] = set()
        self._folders: set[str] = set()

    def take(self, name: str) -> None:
        """Take what the user named: a file, a folder, a pattern or standard input."""
        if name == STDIN:
            self._keep(name, name)
            return
        try:
            mode = os.stat(name).st_mode  # noqa: PTH116  # a Path would drop the "./" that the user gave
        except (OSError, ValueError) as error:
            self._take_pattern(name, error)
            return
        if stat.S_ISDIR(mode):
            self._walk(name)
        elif stat.S_ISREG(mode):
            self._keep(name, os.path.realpath(name))
        else:
            raise UsageError(f"{name} is not a regular file; '-' reads standard input.")

    def _take_pattern(self, pattern: str, error: OSError | ValueError) -> None:
        matches = _matches(pattern)
        if not matches:
            raise UsageError(_absence(pattern, error)) from error
        for match in matches:
            if match.is_dir():
                self._walk(str(match))
            elif match.is_file():
                self._keep(str(match), os.path.realpath(match))
            else:
                self._pass_over(str(match))

    def _walk(self, folder: str) -> None:
        """Keep the assets in `folder`, then those of each folder in it; however deep they lie."""
        waiting = [(folder, os.path.realpath(folder))]
        while waiting:
            named, true = waiting.pop()
            if true in self._folders:
                continue
            self._folders.add(true)
            try:
                with os.scandir(named) as listing:
                    entries = sorted(listing, key=lambda entry: entry.name)
            except OSError as error:
                self.found.passed_over.append(f"the folder {named}: {error.strerror or error}")
                continue
            folders = []
            for entry in entries:
                place = os.path.join(true, entry.name)  # noqa: PTH118  # ten thousand Paths take a second
                if entry.is_dir(follow_symlinks=False):
                    folders.append((entry.path, place))
                elif entry.name.lower().endswith(_ENDINGS):
                    mode = _mode(entry)
                    if stat.S_ISREG(mode):
                        self._keep(entry.path, os.path.realpath(place) if entry.is_symlink() else place)
                    elif not stat.S_ISDIR(mode):
                        self._pass_over(entry.path)
            waiting.extend(reversed(folders))

    def _keep(self, file: str, place: str) -> None:
        if place not in self._files:
            self._files.add(place)
            self.found.files.append(file)

    def _pass_over(self, path: str) -> None:
        self.found.passed_over.append(f"{path}: it is no regular file, or a link to nothing")


def _mode(entry: os.DirEntry[str]) -> int:
    try:
        return entry.stat().st_mode
    except OSError:  # a link to nothing, or to itself
        return 0


def _matches(pattern: str) -> list[Path]:
    if not any(character in pattern for character in _MAGIC):
        return []
    path = Path(pattern)
    try:
        # Not the module glob, whose "**" follows links round and round.
        return sorted(Path(path.anchor).glob(str(path.relative_to(path.anchor))))
    except (ValueError, OSError, RecursionError):  # "a**b" is no pattern
        return []


def _absence(name: str, error: OSError | ValueError) -> str:
    if isinstance(error, ValueError):  # a zero byte, which no name has
        return f"{_short(repr(name))} is not the name of a file."
    if any(character in name for character in _MAGIC):
        return f"Nothing matches {_short(name)}."
    if isinstance(error, FileNotFoundError):
        return f"{_short(name)} does not exist."
    return f"{_short(name)} cannot be read: {error.strerror or error}."


def _short(text: str) -> str:
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]}…"
