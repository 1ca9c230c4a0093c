"""The OpenGL context: EGL, no window, GLSL 3.30 or later; software rasterisation is enough."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Final

from gltf_iri.errors import MissingCapabilityError

if TYPE_CHECKING:
    import moderngl

__all__ = ["GLSL_VERSION_CODE", "INSTALL_COMMAND", "create_context", "renderer_name"]

GLSL_VERSION_CODE: Final = 330
INSTALL_COMMAND: Final = "apt-get install -y --no-install-recommends libegl1 libgl1"


def create_context() -> moderngl.Context:
    """Return a fresh context; raises MissingCapabilityError with what to install where there is no OpenGL.

    Always EGL: the default backend wants an X display.
    """
    import moderngl

    # A failure is told below in one sentence; Mesa would write five lines before it.
    os.environ.setdefault("EGL_LOG_LEVEL", "fatal")
    backend: Any = "egl"  # moderngl's own annotation of this keyword is wrong
    try:
        return moderngl.create_context(standalone=True, backend=backend, require=GLSL_VERSION_CODE)
    except (
        Exception
    ) as error:  # glcontext raises bare Exception for a missing library, ValueError for a version
        reason = " ".join(str(error).split())
        raise MissingCapabilityError(
            f"No OpenGL 3.3 without a window ({reason}); on Debian or Ubuntu run: {INSTALL_COMMAND}"
        ) from error


def renderer_name(context: moderngl.Context) -> str:
    """Return OpenGL's own name for what draws, such as "llvmpipe (LLVM 15.0.6, 256 bits)"."""
    return str(context.info["GL_RENDERER"])
