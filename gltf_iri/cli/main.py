"""Which verbs exist, and how click's own failures become a sentence and an exit code.

This module runs before any verb, so it imports click and nothing else that takes time; a verb's module is
imported only when that verb is called, and ``--help`` reads `VERBS` alone.
"""

from __future__ import annotations

import importlib
from collections.abc import Mapping, Sequence
from types import MappingProxyType

import click

from gltf_iri import __version__
from gltf_iri.cli.ending import PROGRAM, ended, fail

__all__ = ["VERBS", "cli", "run"]

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
    return ended(lambda: _invoke(list(arguments) or ["--help"]))


def _invoke(arguments: list[str]) -> int:
    """Let click read the arguments and call the verb; what click raises becomes an exit code."""
    try:
        # Not cli.main(): that turns a closed pipe into exit code 1, which here means a broken asset.
        with cli.make_context(PROGRAM, arguments) as context:
            cli.invoke(context)
    except click.exceptions.Exit as stop:
        return stop.exit_code
    except click.UsageError as error:
        return fail(_usage_sentence(error), 2)
    except click.ClickException as error:
        return fail(error.format_message(), error.exit_code)
    except click.Abort as error:
        raise KeyboardInterrupt from error
    return 0


def _usage_sentence(error: click.UsageError) -> str:
    path = error.ctx.command_path if error.ctx else PROGRAM
    return f"{error.format_message().rstrip('.')} (see {path} --help)."
