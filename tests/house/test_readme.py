"""What README prints of the map of costs is what the map says."""

from __future__ import annotations

from pathlib import Path

from gltf_iri.planning.method import method_names

ROOT = Path(__file__).resolve().parents[2]
MARKS = ("<!-- accuracy -->", "<!-- /accuracy -->")


def block(text: str) -> str:
    return text.partition(MARKS[0])[2].partition(MARKS[1])[0]


def test_the_table_of_accuracy_is_the_maps_own() -> None:
    printed = block((ROOT / "README.md").read_text(encoding="utf-8"))
    assert printed == block((ROOT / "spec/accuracy/accuracy.md").read_text(encoding="utf-8"))
    assert all(
        f"| `{name}` |" in printed
        for name in (*method_names("film"), *method_names("mirror"), *method_names("layers"))
    )
