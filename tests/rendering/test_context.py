"""A machine without OpenGL is told what to install; one with it says who draws."""

from __future__ import annotations

import moderngl
import pytest

from gltf_iri.errors import MissingCapabilityError, UsageError
from gltf_iri.rendering.context import INSTALL_COMMAND, create_context, renderer_name
from gltf_iri.rendering.targets import Targets, check_size


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


@pytest.mark.parametrize("samples", [-3, 3, 12])
def test_samples_that_opengl_does_not_know_are_a_wrong_call(
    gl_context: moderngl.Context, samples: int
) -> None:
    with pytest.raises(UsageError, match="samples a pixel"):
        check_size(gl_context, (8, 8), samples)


def test_a_driver_without_room_is_a_missing_capability() -> None:
    class Full:
        def renderbuffer(self, *_: object, **__: object) -> None:
            raise moderngl.Error("INCOMPLETE_ATTACHMENT")

    with pytest.raises(MissingCapabilityError, match="smaller size"):
        Targets(Full(), (4000, 4000), samples=4, count=1)  # type: ignore[arg-type]
