"""Over Khronos' own schemas the checker says nothing but what is so, each oddity listed here by name.

The reasons stand in spec/decisions/schema-checker.md.
"""

from __future__ import annotations

from pathlib import Path

from proposal_shimmer import findings

from gltf_iri.proposal.finding import CODES, Severity

# Extension, code, and the end of the place.
ODDITIES = {
    ("ADOBE_materials_clearcoat_specular", "scope-differs", ".schema.json"),
    ("ADOBE_materials_clearcoat_specular", "title-differs", "#/title"),
    ("ADOBE_materials_clearcoat_specular", "default-invalid", "#/properties/clearcoatIor/default"),
    ("ADOBE_materials_clearcoat_specular", "texture-colour-space", "/clearcoatSpecularTexture"),
    ("ADOBE_materials_clearcoat_tint", "texture-channel", "/clearcoatTintTexture"),
    ("ADOBE_materials_thin_transparency", "scope-differs", ".schema.json"),
    ("ADOBE_materials_thin_transparency", "default-may-act", "/transmissionFactor/default"),
    ("ADOBE_materials_thin_transparency", "texture-channel", "/transmissionTexture"),
    ("ADOBE_materials_thin_transparency", "texture-colour-space", "/transmissionTexture"),
    ("EXT_lights_ies", "keyword-without-effect", "/mimeType/anyOf/0/const"),
    ("EXT_lights_image_based", "title-differs", "#/title"),
    ("EXT_mesh_gpu_instancing", "scope-differs", ".schema.json"),
    ("EXT_mesh_manifold", "description-missing", "/manifoldPrimitive"),
    ("EXT_texture_webp", "scope-differs", ".schema.json"),
    ("KHR_lights_punctual", "description-missing", "/spot"),
    ("KHR_materials_anisotropy", "texture-colour-space", "/anisotropyTexture"),
    ("KHR_materials_pbrSpecularGlossiness", "name-case", ""),
    ("KHR_materials_pbrSpecularGlossiness", "scope-differs", ".schema.json"),
    ("KHR_materials_volume", "texture-colour-space", "/thicknessTexture"),
}
# What editors may want to know, and have left as it is.
HABITS = {
    *("description-missing-object", "file-scope", "file-scope-missing", "id-differs", "range-missing"),
    *("ref-not-known", "ref-siblings", "texture-absent-value"),
}


def extensions(shared_dir: Path) -> list[Path]:
    folders = [path for path in (shared_dir / "khr-schemas").iterdir() if path.name != "core"]
    assert len(folders) >= 29
    return sorted(folders)


def test_every_oddity_of_khronos_schemas_is_known(shared_dir: Path) -> None:
    told = [
        (folder.name, finding.code, finding.where)
        for folder in extensions(shared_dir)
        for finding in findings(folder)
        if finding.severity is not Severity.INFORMATION
    ]
    unknown = [
        one
        for one in told
        if not any(one[:2] == known[:2] and one[2].endswith(known[2]) for known in ODDITIES)
    ]
    assert unknown == []
    assert {one[:2] for one in told} == {known[:2] for known in ODDITIES}


def test_no_extension_of_khronos_itself_has_an_error(shared_dir: Path) -> None:
    wrong = {
        folder.name
        for folder in extensions(shared_dir)
        for finding in findings(folder)
        if finding.severity is Severity.ERROR
    }
    assert wrong == {"ADOBE_materials_clearcoat_specular"}


def test_what_khronos_leaves_as_it_is_is_information(shared_dir: Path) -> None:
    told = {
        finding.code
        for folder in extensions(shared_dir)
        for finding in findings(folder)
        if finding.severity is Severity.INFORMATION
    }
    assert told == HABITS
    assert all(CODES[code].severity is Severity.INFORMATION for code in HABITS)


def test_the_core_is_no_extension_and_else_has_one_keyword_of_an_older_draft(shared_dir: Path) -> None:
    """In 2020-12 `dependencies` demands nothing: alphaCutoff passes without alphaMode."""
    told = [(finding.code, finding.where) for finding in findings(shared_dir / "khr-schemas" / "core")]
    names = {"name-form", "file-name"}
    assert {code for code, _ in told} == {*names, "keyword-of-another-draft"}
    assert all(where.endswith("#/dependencies") for code, where in told if code not in names)


def test_the_ratified_text_agrees_with_its_schema(shared_dir: Path, tmp_path: Path) -> None:
    """KHR_materials_iridescence, README and schema together: only its figures are not here."""
    name = "KHR_materials_iridescence"
    root = tmp_path / name
    (root / "schema").mkdir(parents=True)
    for schema in (shared_dir / "khr-schemas" / name / "schema").iterdir():
        (root / "schema" / schema.name).write_bytes(schema.read_bytes())
    (root / "README.md").write_bytes((shared_dir / "seeds" / f"{name}.md").read_bytes())
    told = {
        (finding.code, finding.message) for finding in findings(root) if finding.code != "link-unverified"
    }
    codes = {code for code, _ in told}
    assert codes == {"link-broken", "exclusion-to-propose", "pointer-table-missing"}
    assert all("figures/" in message for code, message in told if code == "link-broken")
