"""The version that a file says it is of, and the least that it asks for."""

from __future__ import annotations

from collections.abc import Callable

import pytest

Codes = Callable[..., set[tuple[str, str | int | None]]]

MAJOR = ("UNKNOWN_ASSET_MAJOR_VERSION", "/asset/version")
MINOR = ("UNKNOWN_ASSET_MINOR_VERSION", "/asset/version")
LEAST = ("ASSET_MIN_VERSION_GREATER_THAN_VERSION", "/asset/minVersion")
FORM = ("PATTERN_MISMATCH", "/asset/version")


@pytest.mark.parametrize(
    ("version", "told"),
    [
        *[(version, set()) for version in ("2.0", "2.00", "02.0")],
        *[(version, {MINOR}) for version in ("2.1", "2.10", "2." + "9" * 5000)],
        *[(version, {MAJOR}) for version in ("3.0", "1.0", "1.9", "10.0", "0.0", "9" * 5000 + ".0")],
        *[(version, {FORM}) for version in ("2", "2.", "", "2.0 ", "2.0.0", "-2.0", "2,0", "٢.٠", "2.0\n")],
    ],
)
def test_versions(version: str, told: set[tuple[str, str]], codes: Codes) -> None:
    assert codes({"asset": {"version": version}}) == told


@pytest.mark.parametrize(
    ("version", "least", "told"),
    [
        ("2.0", "2.0", set()),
        ("2.0", "1.9", set()),
        ("2.0", "2.1", {LEAST}),
        ("2.0", "10.0", {LEAST}),
        ("2.10", "2.9", {MINOR}),
        ("2.9", "2.10", {MINOR, LEAST}),
        ("3.0", "3.1", {MAJOR, LEAST}),
    ],
)
def test_the_least_version_is_not_above_the_version(
    version: str, least: str, told: set[tuple[str, str]], codes: Codes
) -> None:
    assert codes({"asset": {"version": version, "minVersion": least}}) == told
