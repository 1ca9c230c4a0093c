"""`gltf-iri render` from the outside: what it writes, what it prints, and how it refuses."""

from __future__ import annotations

import base64
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from gltf_iri.cli.main import run
from gltf_iri.errors import MissingCapabilityError
from gltf_iri.rendering import context as context_module


@pytest.fixture
def triangle(tmp_path):
    """A file of one triangle with a film over metal."""
    points = np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], np.float32)
    data = base64.b64encode(points.tobytes()).decode()
    film = {"iridescenceFactor": 1.0}
    path = tmp_path / "triangle.gltf"
    path.write_text(
        json.dumps(
            {
                "asset": {"version": "2.0"},
                "extensionsUsed": ["KHR_materials_iridescence"],
                "buffers": [{"byteLength": 36, "uri": f"data:application/octet-stream;base64,{data}"}],
                "bufferViews": [{"buffer": 0, "byteLength": 36}],
                "accessors": [
                    {
                        "bufferView": 0,
                        "componentType": 5126,
                        "type": "VEC3",
                        "count": 3,
                        "min": [-1, -1, 0],
                        "max": [1, 1, 0],
                    }
                ],
                "materials": [{"doubleSided": True, "extensions": {"KHR_materials_iridescence": film}}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
                "nodes": [{"mesh": 0}],
                "scenes": [{"nodes": [0]}],
            }
        )
    )
    return path


def test_an_empty_picture_is_told(gl_context, triangle, tmp_path, capsys):
    gltf = json.loads(triangle.read_text())
    gltf["cameras"] = [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}]
    gltf["nodes"].append({"camera": 0, "translation": [0, 0, -5]})  # looks away, along -z
    gltf["scenes"][0]["nodes"].append(1)
    triangle.write_text(json.dumps(gltf))
    assert run(["render", str(triangle), "-o", str(tmp_path / "a.png"), "--size", "32x24"]) == 0
    assert "note: Nothing of the model is in the picture" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["out.png", "out.webp", "out.exr"])
def test_json_tells_what_was_drawn(gl_context, triangle, tmp_path, capsys, name):
    out = tmp_path / name
    assert run(["render", str(triangle), "-o", str(out), "--size", "32x24", "--env", "white", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert out.stat().st_size > 0
    assert told["out"] == str(out)
    assert told["outputs"] == [str(out)]
    assert told["exposure"] == 0.0
    assert told["size"] == [32, 24]
    assert told["renderer"] and told["ms"] > 0.0
    assert {"image light", "uploads", "opaque", "background", "read"} <= set(told["passes"])
    assert told["method"] == "khr-guarded"
    assert told["environment"] == "white"


def test_the_method_asked_for_is_used(gl_context, triangle, tmp_path, capsys):
    out = str(tmp_path / "a.png")
    assert run(["render", str(triangle), "-o", out, "--size", "8x8", "--method", "khr", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["method"] == "khr"


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["-o", "a.gif"], ".webp or .exr"),
        (["-o", "nowhere/a.png"], "nowhere"),
        (["-o", "a.png", "--size", "640"], "640"),
        (["-o", "a.png", "--size", "0x8"], "0 × 8"),
        (["-o", "a.png", "--size", "99999x1"], "99999 × 1"),
        (["-o", "a.png", "--method", "magic"], "magic"),
        (["-o", "a.png", "--camera", "2"], "no camera 2"),
        (["-o", "a.png", "--env", "missing.hdr"], "missing.hdr"),
        (["-o", "a.png", "--exposure", "nan"], "nan"),
        (["-o", "a.png", "--exposure", "bright"], "neither a number nor auto"),
        (["-o", "a.exr", "--tonemap", "aces"], "not tone mapped"),
        (["-o", "a.png", "--paths", "4"], "add --reference"),
        (["-o", "a.webp", "--orbit", "0"], "not 0"),
        (["-o", "a.webp", "--orbit", "1000000000"], "1 to 360"),
        (["-o", "a.webp", "--orbit", "4", "--camera", "0"], "its own cameras"),
        ([], "--out"),
    ],
)
def test_a_wrong_call_is_one_sentence_and_code_2(
    gl_context, triangle, tmp_path, monkeypatch, capsys, options, said
):
    monkeypatch.chdir(tmp_path)
    assert run(["render", str(triangle), *options]) == 2
    streams = capsys.readouterr()
    assert streams.out == ""
    assert said in streams.err and len(streams.err.strip().splitlines()) == 1
    assert [path.name for path in tmp_path.iterdir()] == ["triangle.gltf"]


@pytest.fixture
def sunlit(triangle):
    """The triangle under a sun of π lux, so that a white card which faces it has radiance 1."""
    gltf = json.loads(triangle.read_text())
    gltf["extensionsUsed"].append("KHR_lights_punctual")
    gltf["extensions"] = {
        "KHR_lights_punctual": {"lights": [{"type": "directional", "intensity": float(np.pi)}]}
    }
    gltf["nodes"].append({"extensions": {"KHR_lights_punctual": {"light": 0}}})
    gltf["scenes"][0]["nodes"].append(1)
    triangle.write_text(json.dumps(gltf))
    return triangle


@pytest.mark.parametrize(
    ("name", "options", "exposure"),
    [
        ("a.png", [], -1.0),
        ("a.exr", [], 0.0),
        ("a.exr", ["--exposure", "auto"], -1.0),
        ("a.webp", ["--exposure", "0.5"], 0.5),
    ],
)
def test_pictures_for_eyes_follow_the_light_and_numbers_do_not(
    gl_context, sunlit, tmp_path, capsys, name, options, exposure
):
    call = ["render", str(sunlit), "-o", str(tmp_path / name), "--size", "8x8", "--env", "white", "--json"]
    assert run([*call, *options]) == 0
    assert json.loads(capsys.readouterr().out)["exposure"] == exposure


def test_the_exposure_that_is_told_gives_the_same_picture(gl_context, sunlit, tmp_path, capsys):
    for options in ([], ["--exposure", "-1"]):
        out = tmp_path / f"{len(options)}.png"
        call = ["render", str(sunlit), "-o", str(out), "--size", "16x16", "--env", "white"]
        assert run([*call, *options]) == 0
        assert "-1 EV" in capsys.readouterr().out
    assert (tmp_path / "0.png").read_bytes() == (tmp_path / "2.png").read_bytes()


@pytest.mark.parametrize(
    ("name", "names"),
    [("a.webp", ["a.webp"]), ("a.png", [f"a-00{i}.png" for i in range(5)])],
)
def test_an_orbit_tells_every_file_that_it_wrote(gl_context, triangle, tmp_path, capsys, name, names):
    from PIL import Image

    folder = tmp_path / "turn"
    folder.mkdir()
    call = ["render", str(triangle), "-o", str(folder / name), "--size", "32x24", "--orbit", "5", "--json"]
    assert run(call) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["outputs"] == [str(folder / name) for name in names]
    assert told["out"] == told["outputs"][0]
    assert sorted(path.name for path in folder.iterdir()) == names
    for path in folder.iterdir():
        with Image.open(path) as picture:
            assert picture.size == (32, 24)
            assert getattr(picture, "n_frames", 1) == (5 if len(names) == 1 else 1)


def test_the_bounds_of_the_options_are_those_of_the_parts():
    from gltf_iri.cli import picture_options
    from gltf_iri.scene.exposure import EXPOSURE_MAX_EV

    assert picture_options._EXPOSURE_MAX_EV == EXPOSURE_MAX_EV


def test_the_reference_needs_no_opengl(triangle, tmp_path, capsys, monkeypatch):
    def missing():
        raise MissingCapabilityError("no OpenGL here")

    monkeypatch.setattr(context_module, "create_context", missing)
    call = ["render", str(triangle), "--size", "12x8", "--env", "white", "--samples", "8", "--json"]
    assert run([*call, "--reference", "-o", str(tmp_path / "a.png")]) == 0
    told = json.loads(capsys.readouterr().out)
    assert (tmp_path / "a.png").exists()
    assert told["renderer"] == "the CPU reference" and told["ms"] > 0
    assert run([*call[:-3], "-o", str(tmp_path / "b.png")]) == 3


def test_the_reference_draws_what_opengl_draws(gl_context, triangle, tmp_path):
    from PIL import Image

    shown = {}
    for name, options in (("a.png", []), ("b.png", ["--reference"])):
        call = ["render", str(triangle), "-o", str(tmp_path / name), "--size", "32x24", "--env", "white"]
        assert run([*call, *options]) == 0
        with Image.open(tmp_path / name) as picture:
            shown[name] = np.asarray(picture).astype(int)
    # Edges differ, which OpenGL smooths; the middle of the triangle and the background do not.
    for row, column in ((14, 16), (1, 1)):
        np.testing.assert_allclose(shown["a.png"][row, column], shown["b.png"][row, column], atol=2)


def test_an_orbit_may_be_drawn_by_the_reference_with_the_truth(triangle, tmp_path, capsys):
    call = ["render", str(triangle), "-o", str(tmp_path / "a.exr"), "--size", "8x6", "--orbit", "2"]
    options = ["--reference", "--samples", "4", "--method", "spectral", "--json"]
    assert run([*call, *options]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["method"] == "spectral"
    assert len(told["outputs"]) == 2


@pytest.mark.skipif(sys.platform == "win32", reason="Ctrl-C is a signal on POSIX only")
def test_an_interrupted_reference_is_one_sentence_and_leaves_nothing(triangle, tmp_path):
    pytest.importorskip("embreex")
    out = tmp_path / "pictures"
    out.mkdir()
    # Hours of work in several processes, whatever the machine.
    call = ["render", str(triangle), "-o", str(out / "a.png"), "--reference", "--samples", "100000"]
    # A suite in the background of a script has SIGINT ignored, and hands that on; a terminal does not.
    heard = "import os, signal, sys; signal.signal(signal.SIGINT, signal.SIG_DFL);"
    heard += "os.execv(sys.executable, [sys.executable, *sys.argv[1:]])"
    with subprocess.Popen(
        [sys.executable, "-c", heard, "-m", "gltf_iri", *call, "--size", "320x240"],
        cwd=Path(__file__).parents[2],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    ) as painting:
        time.sleep(2.5)
        assert painting.poll() is None
        os.killpg(painting.pid, signal.SIGINT)  # as a terminal does: to all processes
        try:
            # Returns when the last process that holds the pipes has ended.
            said = painting.communicate(timeout=30)
        finally:
            if painting.poll() is None:
                os.killpg(painting.pid, signal.SIGKILL)
    assert (painting.returncode, *said) == (130, "", "gltf-iri: Interrupted.\n")
    assert list(out.iterdir()) == []


@pytest.mark.skipif(sys.platform == "win32", reason="the signals are POSIX")
@pytest.mark.parametrize("ending", ["SIGTERM", "SIGHUP"])
def test_a_render_that_is_told_to_end_takes_its_half_written_file_away(triangle, tmp_path, ending):
    out = tmp_path / "pictures"
    out.mkdir()
    call = ["render", str(triangle), "-o", str(out / "turn.webp"), "--size", "640x480", "--orbit", "360"]
    with subprocess.Popen(
        [sys.executable, "-m", "gltf_iri", *call, "--env", "none"],
        cwd=Path(__file__).parents[2],
        stderr=subprocess.PIPE,
        text=True,
    ) as drawing:
        try:
            begun = time.monotonic()
            while not list(out.iterdir()) and time.monotonic() - begun < 60.0:
                time.sleep(0.05)
            assert [path.name[0] for path in out.iterdir()] == ["."]
            drawing.send_signal(getattr(signal, ending))
            said = drawing.communicate(timeout=30)[1]
        finally:
            drawing.kill()
    assert (drawing.returncode, said) == (128 + getattr(signal, ending), "")
    assert list(out.iterdir()) == []
