"""A machine without OpenGL is told what to install; one with it says who draws."""

from __future__ import annotations

import moderngl
import pytest

from gltf_iri.errors import MissingCapabilityError
from gltf_iri.rendering.context import INSTALL_COMMAND, create_context, renderer_name


@pytest.mark.parametrize(
    "failure", [Exception("libEGL.so not loaded"), ValueError("Requested OpenGL version 330")]
)
def test_missing_opengl_is_told_with_the_command_that_installs_it(
    failure: Exception, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(**_: object) -> moderngl.Context:
        raise failure

    monkeypatch.setattr(moderngl, "create_context", fail)
    with pytest.raises(MissingCapabilityError, match="apt-get install") as caught:
        create_context()
    assert str(failure) in str(caught.value)
    assert INSTALL_COMMAND in str(caught.value)
    assert caught.value.exit_code == 3


def test_context_speaks_the_glsl_that_the_shaders_are_written_in(gl_context: moderngl.Context) -> None:
    assert gl_context.version_code >= 330
    assert renderer_name(gl_context) == gl_context.info["GL_RENDERER"]
