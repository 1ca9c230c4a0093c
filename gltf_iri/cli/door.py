"""The way in: everything goes through click, but for plain calls of `validate`, as hooks make them.

Loading click takes longer than judging a small file, and as long as everything else that this needs.
"""

from __future__ import annotations

from collections.abc import Sequence

from gltf_iri.cli.ending import ended

__all__ = ["run"]

# Those two say nothing that needs a look at other options.
_FORMATS = ("text", "json")


def run(arguments: Sequence[str]) -> int:
    """Run the command line and return its exit code, as `gltf_iri.cli.main.run` does."""
    plain = _plain_validation(arguments)
    if plain is None:
        from gltf_iri.cli.main import run as run_with_click

        return run_with_click(arguments)
    form, paths = plain
    return ended(lambda: _validate(form, paths))


def _validate(form: str, paths: tuple[str, ...]) -> int:
    from gltf_iri.cli.validate_files import validate_files
    from gltf_iri.validation.options import Options

    return int(validate_files(paths, Options(), form=form))


def _plain_validation(arguments: Sequence[str]) -> tuple[str, tuple[str, ...]] | None:
    """Return format and paths where nothing else is said, or None where click must read the options."""
    if not arguments or arguments[0] != "validate":
        return None
    forms, paths, is_json = ["text"], [], False
    words = iter(arguments[1:])
    for word in words:
        if word == "--json":
            is_json = True
        elif word == "--format":
            forms.append(next(words, ""))
        elif word.startswith("-") and word != "-":
            return None
        else:
            paths.append(word)
    if not paths or not set(forms) <= set(_FORMATS):
        return None
    return "json" if is_json else forms[-1], tuple(paths)
