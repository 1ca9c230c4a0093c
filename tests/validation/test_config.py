"""A configuration of the Khronos validator serves here too, and a slip in it is told."""

from __future__ import annotations

from pathlib import Path

import pytest

from gltf_iri.errors import UsageError
from gltf_iri.validation.config import Settings, overrides, read_settings

# The keys and the layout of the Khronos validator's own example.
EXAMPLE = """
# Maximum number of issues
max-issues: 10
ignore:
 - UNEXPECTED_PROPERTY
override:
  ACCESSOR_INDEX_TRIANGLE_DEGENERATE: 0
"""


@pytest.fixture
def settings(tmp_path: Path):
    def read(text: str | bytes) -> Settings:
        path = tmp_path / "config.yaml"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return read_settings(path)

    return read


def test_the_keys_of_khronos_are_read(settings) -> None:
    read = settings(EXAMPLE)
    assert read.ignore == {"UNEXPECTED_PROPERTY"}
    assert read.override == {"ACCESSOR_INDEX_TRIANGLE_DEGENERATE": 0}
    assert (read.only, read.max_issues) == (frozenset(), 10)


@pytest.mark.parametrize("text", ["", "# nothing\n", "ignore:\nonly:\noverride:\nmax-issues:\n", "{}"])
def test_a_file_that_says_nothing_changes_nothing(settings, text: str) -> None:
    read = settings(text)
    assert (read.ignore, read.only, read.override, read.max_issues) == (frozenset(), frozenset(), {}, None)


def test_severities_may_be_names_or_numbers(settings) -> None:
    read = settings("override: {UNUSED_OBJECT: Error, NODE_EMPTY: '2', INVALID_URI: 3}")
    assert read.override == {"UNUSED_OBJECT": 0, "NODE_EMPTY": 2, "INVALID_URI": 3}


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("ignored: []", "there is no key 'ignored'; the nearest is 'ignore'"),
        ("max_issues: 3", "there is no key 'max_issues'; the nearest is 'max-issues'"),
        ("ignore: [UNUSED_OBJEKT]", "there is no code 'UNUSED_OBJEKT'; the nearest is 'UNUSED_OBJECT'"),
        ("ignore: [qqqq]", "'ignore': there is no code 'qqqq'."),
        ("ignore: UNUSED_OBJECT", "'ignore' must be a list of codes."),
        ("only: [3]", "'only' must be a list of codes."),
        ("override: [UNUSED_OBJECT]", "'override' must map codes to severities."),
        ("override: {UNUSED_OBJECT: 4}", "UNUSED_OBJECT: 4 is no severity; say error, warning,"),
        ("override: {UNUSED_OBJECT: true}", "true is no severity"),
        ("max-issues: -1", "'max-issues' must be a whole number"),
        ("max-issues: many", "'max-issues' must be a whole number"),
        ("- ignore", "must map keys to values"),
        ("ignore: [UNUSED_OBJECT]\nonly: [NODE_EMPTY]", "exclude each other"),
        ("ignore: [\n}", "is no YAML in line 2"),
        (b"\xff\xfe\x00\xd8", "is no YAML"),
        ("!!python/object/apply:os.system [id]", "is no YAML in line 1"),
        ("[" * 5000, "is no YAML"),
        ("#" * 2_000_000, "too large"),
    ],
)
def test_a_slip_is_told_in_one_sentence(settings, text: str | bytes, told: str) -> None:
    with pytest.raises(UsageError) as refused:
        settings(text)
    sentence = str(refused.value)
    assert told in sentence
    assert "\n" not in sentence


def test_options_add_to_the_file_and_win_over_it(settings) -> None:
    said = Settings(["NODE_EMPTY"], (), overrides(["UNUSED_OBJECT=error", "INVALID_URI=1"]), 0)
    both = settings(EXAMPLE + "  UNUSED_OBJECT: 3\n").with_more(said)
    assert both.ignore == {"NODE_EMPTY", "UNEXPECTED_PROPERTY"}
    assert both.override == {"ACCESSOR_INDEX_TRIANGLE_DEGENERATE": 0, "UNUSED_OBJECT": 0, "INVALID_URI": 1}
    assert both.max_issues == 0


def test_ignoring_in_the_file_excludes_only_among_the_options(settings) -> None:
    with pytest.raises(UsageError, match="exclude each other"):
        settings(EXAMPLE).with_more(Settings((), ["NODE_EMPTY"]))


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["UNUSED_OBJECT"], "has no '='"),
        (["UNUSED_OBJECT="], "'' is no severity"),
        (["UNUSED_OBJECT=fatal"], "'fatal' is no severity"),
    ],
)
def test_an_override_without_code_or_severity_is_refused(words: list[str], told: str) -> None:
    with pytest.raises(UsageError, match=told):
        overrides(words)
