"""Each file has its place on the page: with plan and error, or with the sentence that says why not."""

from __future__ import annotations

import html
import json
import shutil

import pytest

from gltf_iri.cli.main import run
from gltf_iri.errors import UsageError
from gltf_iri.gallery import entry as entry_module
from gltf_iri.gallery.entry import Entry, Setup, make_entry
from gltf_iri.gallery.find import find_assets
from gltf_iri.gallery.page import gallery_html, write_gallery
from gltf_iri.rendering.render import Renderer
from gltf_iri.samples.collection import write_samples
from gltf_iri.scene.environment import white

SETUP = Setup((40, 30), white())


@pytest.fixture(scope="session")
def samples(tmp_path_factory):
    folder = tmp_path_factory.mktemp("collection")
    write_samples(folder)
    return folder


@pytest.fixture
def folder(tmp_path, samples):
    """Two sound files, one of them two folders deep, and between them one that is broken."""
    shutil.copytree(samples / "pearl", tmp_path / "assets" / "deep" / "pearl")
    shutil.copytree(samples / "oil-on-metal", tmp_path / "assets" / "oil-on-metal")
    (tmp_path / "assets" / "broken <b>.gltf").write_text('{"asset": {"version": "2.0"}, "buffers": 3}')
    return tmp_path / "assets"


@pytest.fixture
def renderer(gl_context):
    renderer = Renderer(gl_context)
    yield renderer
    renderer.release()


def test_assets_are_found_in_folders_of_folders_once_and_sorted(folder):
    names = [str(path.relative_to(folder)) for path in find_assets([folder, folder / "deep", folder])]
    assert names == ["broken <b>.gltf", "deep/pearl/pearl.glb", "oil-on-metal/oil-on-metal.gltf"]


def test_a_file_that_is_named_is_shown_whatever_its_ending(folder):
    (folder / "note.txt").write_text("no glTF")
    assert find_assets([folder / "note.txt"]) == (folder / "note.txt",)
    assert folder / "note.txt" not in find_assets([folder])


def test_a_ring_of_links_is_walked_once(folder):
    (folder / "ring").symlink_to(folder)
    assert len(find_assets([folder])) == 3


def test_a_folder_without_assets_is_a_wrong_call(tmp_path):
    with pytest.raises(UsageError, match=r"no \.gltf or \.glb"):
        find_assets([tmp_path])


def test_every_file_stands_on_the_page_with_its_plan_and_error(renderer, folder):
    entries = [make_entry(renderer, path, SETUP) for path in find_assets([folder])]
    assert [entry.is_sound for entry in entries] == [False, True, True]
    page = html.unescape(gallery_html(entries, SETUP))
    for entry in entries:
        assert entry.file.name in page
    for entry in entries[1:]:
        (plan,) = entry.plans
        film = entry.to_json()["materials"][0]["method_vs_truth"]
        assert ", ".join(effect.value for effect in plan.effects) in page
        assert f"by {plan.method}" in page
        for key in ("delta_e_mean", "delta_e_p95", "delta_e_max"):
            assert f"<td>{film[key]:.2g}</td>" in page
        assert f"{entry.comparison.whole.glsl_vs_python.all.max_relative:.2g}" in page
        for effect, reason in plan.skipped.items():
            assert (effect not in plan.absent) == (f"<b>{effect.value}</b>: {reason}" in page)
    assert entries[0].error in page
    assert page.count("data:image/webp;base64,") == 2


def test_what_is_not_drawn_stands_on_the_page(renderer, folder):
    gltf = {
        "asset": {"version": "2.0"},
        "materials": [{"extensions": {"KHR_materials_diffuse_transmission": {}}}],
        "extensionsUsed": ["KHR_materials_diffuse_transmission"],
        **_triangle(),
    }
    path = folder / "sheer.gltf"
    path.write_text(json.dumps(gltf))
    entry = make_entry(renderer, path, SETUP)
    assert entry.error is None
    assert "KHR_materials_diffuse_transmission</b>: not read by this program" in gallery_html([entry], SETUP)


@pytest.mark.parametrize("budget", [None, 5.0])
def test_layers_are_told_as_layers(renderer, folder, budget):
    layer = {"ior2": 1.5, "periodMaximum": 220, "cells": 2, "roughness": 0.6}
    gltf = {
        "asset": {"version": "2.0"},
        "materials": [
            {
                "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0},
                "extensions": {"EXT_materials_bragg": {"braggFactor": 1, "layers": [layer]}},
            }
        ],
        **_triangle(),
    }
    path = folder / "wing.gltf"
    path.write_text(json.dumps(gltf))
    entry = make_entry(renderer, path, Setup((40, 30), white(), budget=budget))
    assert entry.error is None
    (plan,) = entry.plans
    assert plan.layers is not None and (plan.layers.delta_e is None) == (budget is None)
    card = gallery_html([entry], SETUP).split("<article>")[1]
    assert "<th>layers</th>" in card and "film" not in card
    assert f"by {plan.layers.method}" in card and "1 layer by" in card


def test_a_budget_that_nothing_keeps_is_a_files_own_sentence(renderer, folder):
    entry = make_entry(
        renderer, folder / "oil-on-metal" / "oil-on-metal.gltf", Setup((8, 6), None, budget=-1.0)
    )
    assert entry.error is not None and "A budget is" in entry.error


def _triangle():
    data = "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
    return {
        "buffers": [{"byteLength": 36, "uri": data}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [
            {
                "bufferView": 0,
                "componentType": 5126,
                "type": "VEC3",
                "count": 3,
                "min": [0, 0, 0],
                "max": [1, 1, 0],
            }
        ],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "nodes": [{"mesh": 0}],
        "scenes": [{"nodes": [0]}],
    }


def test_a_hostile_name_is_text_and_the_page_loads_nothing(renderer, folder):
    page = gallery_html([make_entry(renderer, folder / "broken <b>.gltf", SETUP)], SETUP)
    assert "broken <b>" not in page and "broken &lt;b&gt;" in page
    assert "<script" not in page and "http" not in page.replace("http-equiv", "")
    assert "default-src 'none'" in page


def test_a_page_that_cannot_be_written_leaves_the_one_before(tmp_path, monkeypatch):
    page = write_gallery([], SETUP, tmp_path)
    before = page.read_bytes()

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pathlib.Path.replace", full)
    with pytest.raises(UsageError, match="No space left"):
        write_gallery([], Setup((8, 8), None), tmp_path)
    assert page.read_bytes() == before
    assert list(tmp_path.iterdir()) == [page]


def test_the_command_draws_the_rest_and_ends_with_1_where_a_file_is_broken(gl_context, folder, capsys):
    call = ["gallery", str(folder / "out"), str(folder), "--size", "40x30", "--env", "white"]
    assert run([*call, "--json"]) == 1
    streams = capsys.readouterr()
    told = json.loads(streams.out)
    assert told["page"] == str(folder / "out" / "index.html")
    broken, pearl, oil = told["files"]
    assert (oil["error"], pearl["error"]) == (None, None)
    assert "/buffers" in broken["error"] and broken["materials"] == [] and broken["picture"] is None
    assert pearl["agrees"] and pearl["materials"][0]["method_vs_truth"]["delta_e_mean"] > 0
    assert streams.err == (
        f"gltf-iri: Of 3 files, 1 could not be drawn; see {folder / 'out' / 'index.html'}.\n"
    )


def test_without_paths_the_samples_are_shown(gl_context, tmp_path, capsys, monkeypatch):
    from gltf_iri.samples.collection import NAMES

    monkeypatch.setattr(entry_module, "make_entry", lambda _, file, __: Entry(file, error="not drawn here"))
    assert run(["gallery", str(tmp_path), "--env", "white"]) == 1
    assert f"({len(NAMES)} files)" in capsys.readouterr().out
    page = (tmp_path / "index.html").read_text()
    assert page.count("<article>") == page.count("not drawn here") == len(NAMES)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["nowhere"], "nowhere"),
        (["--size", "0x3"], "0 × 3"),
        (["--method", "magic"], "magic"),
        (["--budget", "-1"], "A budget is"),
        (["--budget", "1", "--method", "khr"], "do not go together"),
        (["--env", "no.hdr"], "no.hdr"),
    ],
)
def test_a_wrong_call_writes_nothing(gl_context, tmp_path, capsys, options, said):
    assert run(["gallery", str(tmp_path / "out"), *options]) == 2
    assert said in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []
