"""What the user wants to hear, from a configuration of the Khronos validator and from options beside it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from gltf_iri.asset.words import shown
from gltf_iri.errors import AssetError, UsageError
from gltf_iri.validation.codes_table import every_code
from gltf_iri.validation.issue import SEVERITY_NAMES

__all__ = ["KEYS", "Settings", "known_codes", "overrides", "read_settings", "settings_of", "severity_of"]

# The keys of the Khronos validator's docs/config-example.yaml, so that one file serves both.
KEYS = ("max-issues", "ignore", "only", "override")

# A line for each code there is takes some ten kilobytes.
_MAX_BYTES = 2**20


class Settings:
    """Codes to leave out or to tell alone, severities of others, and how many remarks, where it was said."""

    __slots__ = ("ignore", "max_issues", "only", "override")

    def __init__(
        self,
        ignore: Iterable[str] = (),
        only: Iterable[str] = (),
        override: Mapping[str, int] | None = None,
        max_issues: int | None = None,
    ) -> None:
        self.ignore = frozenset(ignore)
        self.only = frozenset(only)
        self.override = dict(override or {})
        self.max_issues = max_issues

    def checked(self, prefix: str = "--") -> Settings:
        """Return these settings; UsageError where a code does not exist, or both choices are used.

        prefix : what stands before an option's name where the user wrote it.
        """
        for option in ("ignore", "only", "override"):
            known_codes(getattr(self, option), f"{prefix}{option}")
        return self.with_more(Settings())

    def with_more(self, more: Settings) -> Settings:
        """Return these settings with `more` added; where both speak of one thing, `more` is right.

        Raises UsageError where codes are then both left out and told alone.
        """
        both = Settings(
            self.ignore | more.ignore,
            self.only | more.only,
            {**self.override, **more.override},
            self.max_issues if more.max_issues is None else more.max_issues,
        )
        if both.ignore and both.only:
            raise UsageError("'ignore' and 'only' exclude each other: give one of them.")
        return both


def known_codes(codes: Iterable[str], where: str) -> frozenset[str]:
    """Return `codes` as a set; UsageError names one that no rule tells, and the nearest."""
    chosen, known = frozenset(codes), every_code()
    for code in sorted(chosen - known.keys()):
        raise UsageError(f"{where}: there is no code {shown(code)}{_nearest(code, known)}.")
    return chosen


def severity_of(value: object, where: str) -> int:
    """Return the number of a severity that is given as a number or by name; UsageError for anything else."""
    if isinstance(value, int) and not isinstance(value, bool) and 0 <= value < len(SEVERITY_NAMES):
        return value
    if isinstance(value, str):
        if value.lower() in SEVERITY_NAMES:
            return SEVERITY_NAMES.index(value.lower())
        if value in ("0", "1", "2", "3"):
            return int(value)
    raise UsageError(f"{where}: {shown(value)} is no severity; say {', '.join(SEVERITY_NAMES)}, or 0 to 3.")


def _nearest(word: str, words: Iterable[str]) -> str:
    """Return words that name the nearest of `words`, or "" where none is like `word`."""
    from difflib import get_close_matches

    close = get_close_matches(word[:100], list(words), n=1)
    return f"; the nearest is {close[0]!r}" if close else ""


def settings_of(
    ignore: Iterable[str], only: Iterable[str], override: Mapping[str, int | str], max_issues: int
) -> Settings:
    """Return the settings that a caller from Python states; UsageError says what is wrong with them."""
    for name, codes in (("ignore", ignore), ("only", only)):
        if isinstance(codes, str):
            raise UsageError(f"{name} takes a list of codes, not one text.")
    if not isinstance(max_issues, int) or max_issues < 0:
        raise UsageError("max_issues must be a whole number, 0 for all.")
    severities = {code: severity_of(value, f"override, {code}") for code, value in override.items()}
    return Settings(ignore, only, severities, max_issues).checked("")


def overrides(said: Iterable[str]) -> dict[str, int]:
    """Return code to severity for words such as "UNUSED_OBJECT=error"; UsageError for any other form."""
    pairs = [(word, *word.partition("=")) for word in said]
    for word, _, sign, _ in pairs:
        if not sign:
            raise UsageError(f"--override {shown(word)} has no '=': say CODE=SEVERITY.")
    return {code: severity_of(value, f"--override {word}") for word, code, _, value in pairs}


def read_settings(path: Path) -> Settings:
    """Read a YAML file of the Khronos validator's keys; UsageError says what is wrong with it."""
    import yaml

    from gltf_iri.asset.guard import read_given

    try:
        stated = yaml.safe_load(read_given(path, _MAX_BYTES))
    except AssetError as error:
        raise UsageError(f"{path} is too large to be a configuration.") from error
    except yaml.MarkedYAMLError as error:
        line = f" in line {error.problem_mark.line + 1}" if error.problem_mark else ""
        raise UsageError(f"{path} is no YAML{line}: {error.problem}.") from error
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        raise UsageError(f"{path} is no YAML.") from error
    if stated is None:
        return Settings()
    if not isinstance(stated, dict):
        raise UsageError(f"{path} must map keys to values: {', '.join(KEYS)}.")
    for key in stated:
        if key not in KEYS:
            raise UsageError(
                f"{path}: there is no key {shown(str(key))}{_nearest(str(key), KEYS)}; {_listed()}."
            )
    return Settings(
        _codes(stated, "ignore", path),
        _codes(stated, "only", path),
        _override(stated, path),
        _max_issues(stated, path),
    ).with_more(Settings())


def _listed() -> str:
    return f"it may have {', '.join(KEYS[:-1])} and {KEYS[-1]}"


def _codes(stated: dict[Any, Any], key: str, path: Path) -> frozenset[str]:
    codes = stated.get(key)
    if codes is None:
        return frozenset()
    if not isinstance(codes, list) or not all(isinstance(code, str) for code in codes):
        raise UsageError(f"{path}: {key!r} must be a list of codes.")
    return known_codes(codes, f"{path}: {key!r}")


def _override(stated: dict[Any, Any], path: Path) -> dict[str, int]:
    override = stated.get("override")
    if override is None:
        return {}
    if not isinstance(override, dict) or not all(isinstance(code, str) for code in override):
        raise UsageError(f"{path}: 'override' must map codes to severities.")
    known_codes(override, f"{path}: 'override'")
    return {code: severity_of(value, f"{path}: {code}") for code, value in override.items()}


def _max_issues(stated: dict[Any, Any], path: Path) -> int | None:
    most = stated.get("max-issues")
    if most is None:
        return None
    if not isinstance(most, int) or isinstance(most, bool) or most < 0:
        raise UsageError(f"{path}: 'max-issues' must be a whole number, 0 for all.")
    return most
