"""Fixtures that more than one folder of tests needs; the only place where tests make an OpenGL context."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import moderngl
import pytest

from gltf_iri.errors import MissingCapabilityError
from gltf_iri.rendering.context import create_context

REQUIRE_GL = "GLTF_IRI_REQUIRE_GL"


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark by fixture, so that no test can use OpenGL or the reference assets without its marker."""
    for item in items:
        names = getattr(item, "fixturenames", ())
        if "gl_context" in names:
            item.add_marker(pytest.mark.gl)
        if "shared_dir" in names:
            item.add_marker(pytest.mark.shared)


@pytest.fixture(scope="session")
def _session_context() -> Iterator[moderngl.Context]:
    try:
        context = create_context()
    except MissingCapabilityError as error:
        if os.environ.get(REQUIRE_GL) == "1":
            pytest.fail(f"{REQUIRE_GL}=1 and there is no context: {error}")
        pytest.skip(str(error))
    yield context
    context.release()


@pytest.fixture
def gl_context(_session_context: moderngl.Context) -> Iterator[moderngl.Context]:
    """The one context of the run; a test that leaves an OpenGL error behind fails."""
    _session_context.__enter__()  # a command that ran since has drawn in a context of its own
    before = _session_context.error
    yield _session_context
    _session_context.__enter__()  # so has, perhaps, the test
    after = _session_context.error
    if (before, after) != ("GL_NO_ERROR", "GL_NO_ERROR"):
        pytest.fail(f"OpenGL error state: {before} before the test, {after} after it.")


@pytest.fixture(scope="session")
def shared_dir() -> Path:
    """The folder of reference assets beside a development checkout."""
    folder = Path(__file__).resolve().parents[2] / "shared"
    if not (folder / "assets").is_dir():
        pytest.skip(f"the reference assets are not there: {folder}")
    return folder


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Say what tests measured (`record_property("measured", sentence)`), not only that a bound held."""
    reports = [*terminalreporter.stats.get("passed", []), *terminalreporter.stats.get("failed", [])]
    for report in reports:
        for key, sentence in report.user_properties:
            if key == "measured":
                terminalreporter.write_line(f"measured: {sentence}")
