"""A shader is put together from its files once each, and every complaint names a true place."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import moderngl
import pytest

from gltf_iri.planning.effects import Effect
from gltf_iri.planning.method import METHODS
from gltf_iri.rendering import source
from gltf_iri.rendering.optics_tables import OPTICS_TABLES
from gltf_iri.rendering.source import ShaderError, assemble, assemble_text, build_program, translate_log
from gltf_iri.rendering.switches import SWITCHES
from gltf_iri.resources import shader_root

OPTICS = sorted(path.relative_to(shader_root()).as_posix() for path in shader_root().glob("optics/*.glsl"))
EVERY_FILE = sorted(path for path in shader_root().rglob("*.*"))
VERTEX = "void main() { gl_Position = vec4(0.0); }\n"


@pytest.fixture
def shaders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty shaders folder of the test's own."""
    monkeypatch.setattr(source, "shader_root", lambda: tmp_path)
    return tmp_path


def code_lines(text: str) -> list[str]:
    return [line for line in text.splitlines() if line and not line.startswith(("//", "#", "precision"))]


def test_a_file_reached_twice_is_included_once(shaders: Path) -> None:
    (shaders / "ground.glsl").write_text("float ground;\n")
    (shaders / "left.glsl").write_text('#include "ground.glsl"\nfloat left;\n')
    (shaders / "right.glsl").write_text('#include "ground.glsl"\nfloat right;\n')
    (shaders / "top.frag").write_text('#include "left.glsl"\n#include "right.glsl"\nfloat top;\n')
    made = assemble("top.frag")
    assert code_lines(made.text) == ["float ground;", "float left;", "float right;", "float top;"]
    assert made.files == (
        "shaders/top.frag",
        "shaders/left.glsl",
        "shaders/ground.glsl",
        "shaders/right.glsl",
    )


def test_a_cycle_is_named_by_its_whole_chain(shaders: Path) -> None:
    (shaders / "a.glsl").write_text('#include "b.glsl"\n')
    (shaders / "b.glsl").write_text('#include "c.glsl"\n')
    (shaders / "c.glsl").write_text('#include "a.glsl"\n')
    with pytest.raises(
        ShaderError, match=r"shaders/a\.glsl -> shaders/b\.glsl -> shaders/c\.glsl -> shaders/a\.glsl"
    ):
        assemble("a.glsl")


def test_an_unknown_include_is_named_with_the_line_that_wants_it(shaders: Path) -> None:
    (shaders / "a.glsl").write_text('float x;\n#include "optics/kehr.glsl"\n')
    with pytest.raises(ShaderError, match=r"shaders/a\.glsl:2: .*'shaders/optics/kehr\.glsl'"):
        assemble("a.glsl")


def test_an_include_in_a_branch_not_taken_stays_available(shaders: Path) -> None:
    (shaders / "film.glsl").write_text("float film;\n")
    text = '#ifdef HAS_METAL\n#include "film.glsl"\n#endif\n#include "film.glsl"\n'
    assert code_lines(assemble_text(text, "t").text) == ["float film;"]


def test_what_is_switched_off_is_not_in_the_source() -> None:
    text = '#ifdef HAS_IRIDESCENCE\n#include "optics/khr.glsl"\n#endif\nvoid main() {}\n'
    assert "iridescent" not in assemble_text(text, "t").text
    assert "iridescent" in assemble_text(text, "t", ["HAS_IRIDESCENCE"]).text


def test_defines_stand_after_the_version_in_the_order_given() -> None:
    made = assemble_text("int n = LIGHT_COUNT;\n", "t", ["HAS_METAL", "LIGHT_COUNT 3", "HAS_DIELECTRIC"])
    assert made.text.splitlines()[:4] == [
        "#version 330 core",
        "#define HAS_METAL",
        "#define LIGHT_COUNT 3",
        "#define HAS_DIELECTRIC",
    ]


@pytest.mark.parametrize(
    ("text", "defines", "message"),
    [
        ("void main() {}\n", ["HAS_MEATL"], "'HAS_MEATL' is not a switch"),
        ("void main() {}\n", ["LIGHT_COUNT 3"], "No line of t uses the define 'LIGHT_COUNT 3'"),
        ("float x;\n#ifdef HAS_MEATL\n#endif\n", [], "t:2: 'HAS_MEATL' is not a switch"),
        ("#ifdef HAS_METAL\n", [], "t: a condition is opened and not closed"),
    ],
)
def test_a_define_that_would_do_nothing_is_refused(text: str, defines: list[str], message: str) -> None:
    with pytest.raises(ShaderError, match=re.escape(message)):
        assemble_text(text, "t", defines)


def test_every_effect_and_method_with_a_twin_has_its_switch() -> None:
    assert {effect.define for effect in Effect} <= SWITCHES
    twins = {m.define for m in METHODS.values() if m.glsl_function}
    assert {s for s in SWITCHES if s.startswith("METHOD_")} == twins


@pytest.mark.parametrize("path", EVERY_FILE, ids=lambda path: path.relative_to(shader_root()).as_posix())
def test_every_condition_in_the_shaders_asks_for_a_known_switch(path: Path) -> None:
    assemble_text(path.read_text(encoding="utf-8"), path.name)


@pytest.mark.parametrize("entry", OPTICS)
def test_optics_compile_alone(entry: str, gl_context: moderngl.Context) -> None:
    fragment = assemble_text(f'#include "{entry}"\nout vec4 o;\nvoid main() {{ o = vec4(0.0); }}\n', "t")
    build_program(gl_context, assemble_text(VERTEX, "v"), fragment).release()


@pytest.mark.parametrize("version", ["330 core", "300 es"])
@pytest.mark.parametrize("entry", OPTICS)
def test_optics_are_valid_on_desktop_and_on_embedded_gl(entry: str, version: str, tmp_path: Path) -> None:
    validator = shutil.which("glslangValidator")
    if validator is None:
        pytest.skip("glslangValidator is not installed (apt-get install glslang-tools)")
    made = assemble_text(
        f'#include "{entry}"\nout vec4 o;\nvoid main() {{ o = vec4(0.0); }}\n', "t", version=version
    )
    file = tmp_path / "optics.frag"
    file.write_text(made.text, encoding="utf-8")
    run = subprocess.run([validator, str(file)], capture_output=True, text=True, check=False)
    assert run.returncode == 0, translate_log(run.stdout, made)


@pytest.mark.parametrize("entry", OPTICS)
def test_optics_hold_functions_constants_and_known_tables_only(entry: str) -> None:
    text = assemble(entry).text
    tables = "|".join(OPTICS_TABLES)
    text = re.sub(rf"^uniform highp u?sampler2D ({tables});$", "", text, flags=re.MULTILINE)
    assert not re.search(r"^\s*(uniform|in|out|varying|attribute|layout)\b(?!.*\))", text, re.MULTILINE)


def test_a_compile_error_names_file_and_line(shaders: Path, gl_context: moderngl.Context) -> None:
    (shaders / "broken.glsl").write_text("// one\n// two\nfloat f(float x) { return x + missing; }\n")
    (shaders / "top.frag").write_text(
        'out vec4 o;\n#include "broken.glsl"\nvoid main() { o = vec4(f(1.0)); }\n'
    )
    with pytest.raises(ShaderError, match=r"shaders/broken\.glsl:3: .*missing") as caught:
        build_program(gl_context, assemble_text(VERTEX, "v"), assemble("top.frag", ["HAS_METAL"]))
    assert caught.value.exit_code == 1


def test_a_compile_error_after_a_dropped_branch_keeps_its_line(gl_context: moderngl.Context) -> None:
    text = "out vec4 o;\n#ifdef HAS_METAL\nfloat a;\nfloat b;\n#endif\nvoid main() { o = vec4(missing); }\n"
    with pytest.raises(ShaderError, match=r"film\.frag:6: .*missing"):
        build_program(gl_context, assemble_text(VERTEX, "v"), assemble_text(text, "film.frag"))


@pytest.mark.parametrize(
    "line",
    [
        "0:4(14): error: `foo' undeclared",  # Mesa
        '0(4) : error C1503: undefined variable "foo"',  # NVIDIA
        "ERROR: 0:4: 'foo' : undeclared identifier",  # ANGLE, AMD
        "ERROR: /somewhere/optics.frag:4: 'foo' : undeclared identifier",  # glslang
    ],
)
def test_every_drivers_format_is_told_as_file_and_line(line: str) -> None:
    vertex = assemble_text("float v;\n", "v.vert")
    fragment = assemble_text("// one\n// two\nfloat x = foo;\n", "f.frag")
    log = f"GLSL Compiler failed\n\nfragment_shader\n===============\n{line}\n"
    told = translate_log(log, vertex, fragment)
    assert re.search(r"^f\.frag:3: .*foo", told, re.MULTILINE)
