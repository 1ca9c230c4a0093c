"""`gltf-iri plan`: the contract's JSON, and a text that says only what the file gives reason to say."""

from __future__ import annotations

import base64
import json
import os
import struct
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from gltf_iri.cli.main import run
from gltf_iri.planning.effects import MATERIAL_EFFECTS
from gltf_iri.samples.png import encode_png

FILM = {"KHR_materials_iridescence": {"iridescenceFactor": 1.0}}
SHARED = Path(__file__).parents[3] / "shared"
ASSETS = sorted(path for path in SHARED.glob("assets/*/**/*") if path.suffix in {".gltf", ".glb"})


def triangle(materials, *, uri=None, material=0):
    """Return a glTF of one triangle; without `uri` its buffer lies inside."""
    data = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
    primitive = {"attributes": {"POSITION": 0}, **({} if material is None else {"material": material})}
    return {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [primitive]}],
        "accessors": [
            {
                "bufferView": 0,
                "componentType": 5126,
                "count": 3,
                "type": "VEC3",
                "min": [0, 0, 0],
                "max": [1, 1, 0],
            }
        ],
        "bufferViews": [{"buffer": 0, "byteLength": len(data)}],
        "buffers": [
            {
                "byteLength": len(data),
                "uri": uri or "data:application/octet-stream;base64," + base64.b64encode(data).decode(),
            }
        ],
        **({"materials": materials} if materials else {}),
    }


@pytest.fixture
def plan(tmp_path, capsys):
    """Return a function that plans a glTF given as an object: (exit code, stdout, stderr)."""

    def call(gltf, *options):
        path = tmp_path / "asset.gltf"
        path.write_text(json.dumps(gltf), encoding="utf-8")
        code = run(["plan", str(path), *options])
        shown = capsys.readouterr()
        return code, shown.out, shown.err

    return call


def test_the_json_has_the_contracts_keys_and_tells_every_effect(plan):
    code, out, _ = plan(triangle([{"name": "shell", "extensions": FILM}]), "--json")
    assert code == 0
    (row,) = json.loads(out)["materials"]
    assert row["name"] == "shell"
    assert row["method"] == "khr-guarded"
    told = {*row["effects"], *row["skipped"], *row["not_drawn"]}
    assert told == {effect.value for effect in MATERIAL_EFFECTS}
    assert all(row["skipped"].values())


def test_a_method_that_is_asked_for_is_planned(plan):
    _, out, _ = plan(triangle([{"extensions": FILM}]), "--json", "--method", "khr")
    assert json.loads(out)["materials"][0]["method"] == "khr"


def test_a_scene_without_iridescence_shows_none(plan):
    gltf = triangle([{"name": "plain"}])
    row = json.loads(plan(gltf, "--json")[1])
    assert not [effect for effect in row["materials"][0]["effects"] if "iridescence" in effect]
    assert row["materials"][0]["method"] is None
    assert row["permutations"]
    assert not [d for p in row["permutations"] for d in p["defines"] if "IRID" in d or "METHOD" in d]
    assert "iridescence" not in plan(gltf)[1]


def test_the_permutations_name_the_materials_that_share_them(plan):
    gltf = triangle([{"extensions": FILM}, {}, {"extensions": FILM}])
    primitive = gltf["meshes"][0]["primitives"][0]
    gltf["meshes"][0]["primitives"] = [{**primitive, "material": i} for i in (2, 1, 0)]
    rows = json.loads(plan(gltf, "--json")[1])["permutations"]
    assert [row["materials"] for row in rows] == [[0, 2], [1]]
    assert rows[0]["defines"][:4] == [
        *("HAS_IMAGE_LIGHT", "HAS_METAL", "HAS_IRIDESCENCE", "METHOD_KHR_GUARDED")
    ]


def test_gltfs_default_material_is_planned_last_where_it_is_used(plan):
    rows = json.loads(plan(triangle([{"name": "unused"}], material=None), "--json")[1])["materials"]
    assert [row["index"] for row in rows] == [0, -1]
    assert plan(triangle([], material=None))[1].splitlines()[1].startswith("glTF's default  calls for  metal")


PNG_GREY_51 = encode_png(np.full((2, 2, 3), 51, np.uint8))


def with_texture(gltf, data):
    """Return `gltf` with an image of `data` as texture 0."""
    uri = "data:image/png;base64," + base64.b64encode(data).decode()
    return {**gltf, "images": [{"uri": uri}], "textures": [{"source": 0}]}


def test_a_texture_of_one_value_is_left_out_and_what_that_saves_is_told(plan):
    film = {"iridescenceFactor": 1.0, "iridescenceTexture": {"index": 0}}
    gltf = with_texture(triangle([{"extensions": {"KHR_materials_iridescence": film}}]), PNG_GREY_51)
    told = json.loads(plan(gltf, "--json")[1])
    (row,) = told["materials"]
    assert row["skipped"]["iridescence-texture"] == "every texel is 0.2, which is in the factor now"
    assert row["saved_ns_per_pixel"]["iridescence-texture"] > 0.0
    (shader,) = told["permutations"]
    assert "HAS_IRIDESCENCE_TEXTURE" in shader["pruned_defines"]
    assert set(shader["pruned_defines"]).isdisjoint(shader["defines"])
    assert "which is in the factor now (saves " in plan(gltf)[1]


def test_a_broken_image_is_planned_for_as_if_it_held_anything(plan):
    film = {"iridescenceFactor": 1.0, "iridescenceTexture": {"index": 0}}
    gltf = with_texture(triangle([{"extensions": {"KHR_materials_iridescence": film}}]), PNG_GREY_51[:40])
    code, out, err = plan(gltf)
    assert code == 0
    assert "iridescence-texture" in out.splitlines()[1]
    assert "/images/0: " in err
    assert "It may hold anything, for all the plan knows." in err


def test_a_scene_whose_materials_mention_nothing_prunes_nothing(plan):
    (shader,) = json.loads(plan(triangle([{}]), "--json")[1])["permutations"]
    assert shader["pruned_defines"] == ["HAS_DIELECTRIC"]


def test_materials_are_planned_although_the_buffer_is_missing(plan):
    code, out, err = plan(triangle([{"name": "shell", "extensions": FILM}], uri="lost.bin"))
    assert code == 0
    assert "khr-guarded" in out
    assert err.startswith("note: The shader permutations are left out: ")
    assert "lost.bin" in err


def test_the_text_gives_the_reasons_for_what_the_file_mentions(plan):
    _, out, _ = plan(triangle([{"extensions": {"KHR_materials_iridescence": {}}}]))
    assert "iridescence: the factor is 0" in out
    assert "KHR_materials_unlit" not in out


def test_what_is_not_drawn_is_named(plan):
    extensions = {"KHR_materials_diffuse_transmission": {}}
    _, out, _ = plan(triangle([{"extensions": extensions}]))
    assert "not drawn  KHR_materials_diffuse_transmission: not read by this program" in out


def test_a_pipe_that_cannot_hold_a_name_gets_an_escape(tmp_path):
    path = tmp_path / "asset.gltf"
    path.write_text(json.dumps(triangle([{"name": "λ"}])), encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-m", "gltf_iri", "plan", str(path)],
        cwd=Path(__file__).parents[2],
        env={**os.environ, "PYTHONIOENCODING": "latin-1"},
        capture_output=True,
        text=True,
        check=True,
    )
    assert "0 \\u03bb" in done.stdout


@pytest.mark.parametrize(
    ("extensions", "options", "exit_code", "said"),
    [
        (FILM, ["--method", "airy"], 2, "There is no method 'airy'"),
        (
            {"KHR_materials_ior": {"ior": 0.5}},
            [],
            1,
            "/materials/0/extensions/KHR_materials_ior/ior: 0.5 is outside",
        ),
    ],
)
def test_errors_are_one_sentence(plan, extensions, options, exit_code, said):
    code, out, err = plan(triangle([{"extensions": extensions}]), *options)
    assert (code, out) == (exit_code, "")
    assert said in err
    assert err.count("\n") == 1


@pytest.mark.shared
@pytest.mark.skipif(not ASSETS, reason="the reference assets do not lie beside this checkout")
@pytest.mark.parametrize("path", ASSETS or [None], ids=lambda path: path.stem if path else "")
def test_every_reference_asset_is_planned(path, capsys):
    assert run(["plan", str(path), "--json"]) == 0
    printed = json.loads(capsys.readouterr().out)
    used = json.loads(path.read_text("utf-8")).get("extensionsUsed", []) if path.suffix == ".gltf" else None
    for row in printed["materials"]:
        assert {*row["effects"], *row["skipped"], *row["not_drawn"]} >= {e.value for e in MATERIAL_EFFECTS}
    films = [row for row in printed["materials"] if "iridescence" in row["effects"]]
    if path.parts[-3] == "plain" or (used is not None and "KHR_materials_iridescence" not in used):
        assert not films
        assert not [d for p in printed["permutations"] for d in p["defines"] if "IRID" in d or "METHOD" in d]
    else:
        assert films
