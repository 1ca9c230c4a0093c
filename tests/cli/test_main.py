"""The door: verbs are lazy, failures are one sentence and an exit code."""

from __future__ import annotations

import errno
import importlib
import os
import subprocess
import sys
from pathlib import Path

import click
import pytest

import gltf_iri
from gltf_iri.cli import main
from gltf_iri.errors import AssetError, MissingCapabilityError, UsageError

ROOT = Path(__file__).parents[2]
# What costs time to import, and what a verb's own module would pull in.
HEAVY = {
    "numpy",
    "scipy",
    "colour",
    "matplotlib",
    "moderngl",
    "pygltflib",
    "trimesh",
    "rich",
    "PIL",
    "jinja2",
}


@pytest.fixture
def failing_verb(monkeypatch: pytest.MonkeyPatch):
    """Return a function that replaces every verb by one that raises what it is given."""

    def install(error: BaseException) -> None:
        @click.command
        def command() -> None:
            raise error

        monkeypatch.setattr(main._LazyGroup, "get_command", lambda *_: command)

    return install


def loaded_by(*arguments: str) -> set[str]:
    code = (
        "import sys; from gltf_iri.cli.main import run; "
        f"code = run({list(arguments)!r}); print(code, *sys.modules, file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    code_text, *modules = done.stderr.split()
    assert code_text == "0"
    return set(modules)


@pytest.mark.parametrize("arguments", [["--help"], ["--version"], []])
def test_help_and_version_import_no_verb_and_nothing_heavy(arguments):
    modules = loaded_by(*arguments)
    assert not HEAVY & modules
    assert not {f"gltf_iri.cli.{verb}" for verb in main.VERBS} & modules


@pytest.mark.parametrize("verb", main.VERBS)
def test_the_help_of_a_verb_imports_nothing_heavy(verb):
    assert not HEAVY & loaded_by(verb, "--help")


@pytest.mark.parametrize("verb", main.VERBS)
def test_every_verb_is_a_command_with_help(verb):
    command = importlib.import_module(f"gltf_iri.cli.{verb}").command
    assert isinstance(command, click.Command)
    assert command.help


def test_help_names_every_verb_with_its_line(capsys):
    assert main.run(["--help"]) == 0
    shown = capsys.readouterr().out
    for verb, line in main.VERBS.items():
        assert f"{verb} " in shown
        assert line in shown


def test_the_version_that_is_printed_is_the_packages(capsys):
    assert main.run(["--version"]) == 0
    assert capsys.readouterr().out == f"gltf-iri {gltf_iri.__version__}\n"


@pytest.mark.parametrize(
    ("error", "exit_code", "sentence"),
    [
        (
            AssetError("2 is outside [0, 1]", pointer="/materials/0", file=Path("a.gltf")),
            1,
            "gltf-iri: a.gltf: /materials/0: 2 is outside [0, 1].\n",
        ),
        (UsageError("There is no scene 9."), 2, "gltf-iri: There is no scene 9.\n"),
        (MissingCapabilityError("Install libegl1."), 3, "gltf-iri: Install libegl1.\n"),
        (
            PermissionError(errno.EACCES, "Permission denied", "out.png"),
            2,
            "gltf-iri: out.png: Permission denied.\n",
        ),
        (click.ClickException("Bad day."), 1, "gltf-iri: Bad day.\n"),
        (
            ModuleNotFoundError("No module 'jinja2'", name="jinja2"),
            3,
            "gltf-iri: A package does not load (No module 'jinja2'); install gltf-iri anew with pip.\n",
        ),
        (KeyboardInterrupt(), 130, "gltf-iri: Interrupted.\n"),
        (
            MemoryError(),
            3,
            "gltf-iri: The machine has too little memory for this: ask for a smaller picture.\n",
        ),
    ],
)
def test_a_failure_is_one_sentence_on_stderr_and_its_exit_code(
    failing_verb, capsys, error, exit_code, sentence
):
    failing_verb(error)
    assert main.run(["plan"]) == exit_code
    shown = capsys.readouterr()
    assert shown.out == ""
    assert shown.err == sentence


@pytest.mark.parametrize(
    "bug",
    [
        ZeroDivisionError("division by zero"),
        ImportError("cannot import name 'x'", name="gltf_iri.optics"),
        ImportError("no name at all"),
    ],
)
def test_a_bug_is_not_swallowed(failing_verb, bug):
    failing_verb(bug)
    with pytest.raises(type(bug)):
        main.run(["plan"])


def test_a_hostile_name_cannot_steer_the_terminal(failing_verb, capsys):
    failing_verb(AssetError("material '\x1b[2J\nred' is broken"))
    main.run(["plan"])
    assert capsys.readouterr().err == "gltf-iri: material '\N{REPLACEMENT CHARACTER}[2J red' is broken.\n"


@pytest.mark.parametrize(
    "arguments", [["paint"], ["--colour"], ["plan", "--colour"], ["plan", "no/such/file.glb"]]
)
def test_a_wrong_call_is_one_line_and_exit_code_2(capsys, arguments):
    assert main.run(arguments) == 2
    shown = capsys.readouterr()
    assert shown.out == ""
    assert shown.err.count("\n") == 1
    assert "--help)" in shown.err


def test_a_reader_that_leaves_early_ends_the_program_quietly():
    read_end, write_end = os.pipe()
    os.close(read_end)
    try:
        done = subprocess.run(
            [sys.executable, "-m", "gltf_iri", "--help"],
            cwd=ROOT,
            stdout=write_end,
            stderr=subprocess.PIPE,
            check=False,
        )
    finally:
        os.close(write_end)
    assert done.returncode == 128 + 13
    assert done.stderr == b""


@pytest.mark.parametrize(
    ("arguments", "exit_code"), [(["--version"], 0), (["evaluate", "--cos", "1"], 0), (["paint"], 2)]
)
@pytest.mark.parametrize("closed", [">&-", "2>&-", ">&- 2>&-"])
def test_closed_streams_change_no_exit_code(arguments, exit_code, closed):
    done = subprocess.run(
        ["bash", "-c", f'"$@" {closed}', "bash", sys.executable, "-m", "gltf_iri", *arguments],
        cwd=ROOT,
        capture_output=True,
        check=False,
    )
    assert done.returncode == exit_code
    assert b"Traceback" not in done.stderr
