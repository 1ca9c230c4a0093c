"""The project's own proposal is clean, and each fault put into it is told by the finding that names it."""

from __future__ import annotations

import shutil
from collections import Counter
from pathlib import Path

import pytest
from proposal_shimmer import Edit, findings, in_json, in_text

from gltf_iri.proposal.check import check_proposal

NAME = "EXT_materials_bragg"
PROPOSAL = Path(__file__).parents[2] / "spec" / NAME
MATERIAL = f"schema/material.{NAME}.schema.json"
LAYER = f"schema/material.{NAME}.layer.schema.json"
README = "README.md"
POINTER = f"/materials/{{}}/extensions/{NAME}"
SILENT = {"description": "A texture.", "gltf_detailedDescription": "Linear; 1.0 if it is not given."}
CONTRADICTION = (
    "\n## Interaction with Unlit Materials\n\n`KHR_materials_unlit` and layers go together.\n\n## Fallback"
)


def row(name: str) -> Edit:
    """Return an edit that drops the first line of the README that holds `name`."""

    def edit(root: Path) -> None:
        lines = (root / README).read_text(encoding="utf-8").splitlines()
        position = next(i for i, line in enumerate(lines) if name in line)
        del lines[position]
        (root / README).write_text("\n".join(lines), encoding="utf-8")

    return edit


def of_factor(**keywords: object) -> Edit:
    return in_json(MATERIAL, lambda tree: tree["properties"]["braggFactor"].update(keywords))


BROKEN: list[tuple[str, Edit]] = [
    ("keyword-of-another-draft", of_factor(const=0)),
    ("schema-illegal", of_factor(exclusiveMinimum=0)),
    ("default-invalid", in_json(LAYER, lambda tree: tree["properties"]["cells"].update(minimum=2))),
    ("ref-unresolved", in_text(LAYER, "glTFProperty.schema.json", "glTFObject.schema.json")),
    ("ref-outside", in_text(LAYER, "glTFProperty.schema.json", "../../../../etc/passwd")),
    ("ref-outside", in_text(LAYER, "glTFProperty.schema.json", "http://example.org/a.schema.json")),
    ("closed-object", in_json(LAYER, lambda tree: tree.update(additionalProperties=False))),
    ("texture-channel", in_json(MATERIAL, lambda tree: tree["properties"]["braggTexture"].update(SILENT))),
    ("heading-differs", in_text(README, "# EXT\\_materials\\_bragg", "# EXT\\_materials\\_mirror")),
    ("table-missing-property", row("| **hostIor**")),
    ("table-unknown-property", in_text(README, "| **fill** ", "| **gap** | `x` | Gap. | No |\n| **fill** ")),
    ("table-default", in_text(README, "No, default: `1.5`", "No, default: `1.4`")),
    ("example-broken", in_text(README, '"ior2": 1.56,', '"ior2": 1.56')),
    ("example-invalid", in_text(README, '"ior2": 1.56,', '"ior2": 0.56,')),
    ("exclusion-contradicted", in_text(README, "\n## Fallback", CONTRADICTION)),
    ("pointer-missing", row(f"`{POINTER}/layers/{{}}/fill`")),
    (
        "pointer-unknown",
        in_text(README, f"| `{POINTER}/h", f"| `{POINTER}/x` | `float` | |\n| `{POINTER}/h"),
    ),
    ("pointer-type", in_text(README, f"`{POINTER}/hostIor` | `float`", f"`{POINTER}/hostIor` | `float3`")),
]


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    return Path(shutil.copytree(PROPOSAL, tmp_path / NAME))


def test_the_proposal_is_checked_whole_and_clean() -> None:
    report = check_proposal(PROPOSAL)
    assert report.skipped == {}
    # Khronos' extensions are not ours to edit: that they must be asked is all there is to say.
    assert {finding.code for finding in report.findings} == {"exclusion-to-propose"}


@pytest.mark.parametrize(("code", "edit"), BROKEN, ids=[f"{i}-{code}" for i, (code, _) in enumerate(BROKEN)])
def test_a_fault_in_it_is_told_by_the_finding_that_names_it_alone(copy: Path, code: str, edit: Edit) -> None:
    before = Counter(finding.code for finding in findings(copy))
    edit(copy)
    after = Counter(finding.code for finding in findings(copy))
    assert after - before == Counter([code])


def test_a_finding_shows_a_long_pointer_to_its_end(tmp_path):
    root = tmp_path / NAME
    shutil.copytree(PROPOSAL, root)
    pointer = f"{POINTER}/braggPeriodTexture/extensions/KHR_texture_transform/offset"
    in_text(README, f"`{pointer}` | `float2`", f"`{pointer}` | `float3`")(root)
    (finding,) = (one for one in check_proposal(root).findings if one.code == "pointer-type")
    assert f"'{pointer}' is 'float3' here" in finding.message
