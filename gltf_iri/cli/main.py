"""The entry: which verbs exist, and how every failure becomes a sentence and an exit code.

This module runs before any verb, so it imports click and nothing else that takes time; a verb's module is
imported only when that verb is called, and ``--help`` reads `VERBS` alone.
"""

from __future__ import annotations

import importlib
import io
import os
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

import click

from gltf_iri import __version__
from gltf_iri.cli.common import printable
from gltf_iri.errors import GltfIriError

__all__ = ["VERBS", "cli", "run"]

PROGRAM = "gltf-iri"
PACKAGE = "gltf_iri"

# Verb → the line that `--help` shows; the command itself is `command` in gltf_iri/cli/<verb>.py.
VERBS: Mapping[str, str] = MappingProxyType(
    {
        "evaluate": "Reflectance colour of a film, a mirror or layers over angles.",
        "plan": "What each material of a file calls for, what is left out, and why.",
        "render": "Draw a file to a picture, still or turning, without a window.",
        "compare": "Hold GLSL, Python and spectral truth against each other.",
        "gallery": "Draw many files onto one page, with plan and error beside each.",
        "validate": "Check glTF files with the Khronos codes, and films with our own.",
        "schema": "Check a proposal for a glTF extension, its schemas and its README.",
        "bench": "Time and error of every method.",
        "samples": "Write the sample assets.",
    }
)

# What shells report for a program that a signal ended: 128 + SIGINT and 128 + SIGPIPE.
_INTERRUPTED = 130
_READER_LEFT = 141


class _LazyGroup(click.Group):
    """A group that knows its verbs' names and help without importing them."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(VERBS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in VERBS:
            return None
        command = importlib.import_module(f"gltf_iri.cli.{cmd_name}").command
        return command if isinstance(command, click.Command) else None

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        with formatter.section("Verbs"):
            formatter.write_dl(list(VERBS.items()))


@click.group(
    cls=_LazyGroup,
    no_args_is_help=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog="Exit codes: 0 done and sound, 1 the asset or comparison has errors, 2 wrong call, "
    "3 the machine lacks something.",
)
@click.version_option(__version__, prog_name=PROGRAM, message="%(prog)s %(version)s")
def cli() -> None:
    """Thin-film iridescence for glTF: a picture, a number, and how far each is from the truth."""


def run(arguments: Sequence[str]) -> int:
    """Run the command line and return its exit code; every expected failure becomes one line on stderr."""
    _open_closed_streams()
    if isinstance(sys.stdout, io.TextIOWrapper):
        # A terminal or pipe without λ or é shows an escape instead; a traceback would lose the result.
        sys.stdout.reconfigure(errors="backslashreplace")
    try:
        # Not cli.main(): that turns a closed pipe into exit code 1, which here means a broken asset.
        with cli.make_context(PROGRAM, list(arguments) or ["--help"]) as context:
            cli.invoke(context)
        sys.stdout.flush()  # so that a reader who left is noticed here and not at shutdown
    except click.exceptions.Exit as stop:
        return _flushed(stop.exit_code)
    except click.UsageError as error:
        return _fail(_usage_sentence(error), 2)
    except click.ClickException as error:
        return _fail(error.format_message(), error.exit_code)
    except GltfIriError as error:
        return _fail(str(error), error.exit_code)
    except (KeyboardInterrupt, click.Abort):
        return _fail("Interrupted.", _INTERRUPTED)
    except BrokenPipeError:
        return _reader_left()
    except OSError as error:
        return _fail(_system_sentence(error), 2)
    except ImportError as error:
        if (error.name or PACKAGE).partition(".")[0] == PACKAGE:
            raise  # ours: a bug
        return _fail(f"A package does not load ({error}); install {PROGRAM} anew with pip.", 3)
    except MemoryError:
        return _fail("The machine has too little memory for this: ask for a smaller picture.", 3)
    return 0


def _open_closed_streams() -> None:
    """Let a caller close stdout or stderr (`>&-`): what goes there is lost, the work is done all the same."""
    # Python leaves None in the place of such a stream, and the next file opened would get its number.
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, Path(os.devnull).open("w"))  # noqa: SIM115  # for the life of the process


def _fail(sentence: str, exit_code: int) -> int:
    try:
        click.echo(f"{PROGRAM}: {printable(sentence)}", err=True)
    except BrokenPipeError:
        return _reader_left()
    return exit_code


def _flushed(exit_code: int) -> int:
    try:
        sys.stdout.flush()
    except BrokenPipeError:
        return _reader_left()
    return exit_code


def _reader_left() -> int:
    """End without a message: in `gltf-iri … | head` it is normal that the reader stops early."""
    # The interpreter flushes stdout once more as it ends and would complain about the closed pipe.
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return _READER_LEFT


def _usage_sentence(error: click.UsageError) -> str:
    path = error.ctx.command_path if error.ctx else PROGRAM
    return f"{error.format_message().rstrip('.')} (see {path} --help)."


def _system_sentence(error: OSError) -> str:
    reason = error.strerror or str(error)
    return f"{error.filename}: {reason}." if error.filename else f"{reason}."
