"""glTF's version numbers, "major.minor", compared as text: they may be longer than any integer."""

from __future__ import annotations

__all__ = ["KNOWN", "version_key"]

# The one version that there is (glTF 2.0 specification, §5.9).
KNOWN = "2.0"


def version_key(version: str) -> tuple[tuple[int, str], tuple[int, str]]:
    """Return a major and a minor number that sort as numbers do; `version` has the form of the schema."""
    major, _, minor = version.partition(".")
    return _number(major), _number(minor)


def _number(digits: str) -> tuple[int, str]:
    plain = digits.lstrip("0")
    return len(plain), plain
