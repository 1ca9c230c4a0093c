"""Shipped data is found in a wheel before a checkout, and its loss is told."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from gltf_iri import resources
from gltf_iri.errors import MissingCapabilityError


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An installed package of the test's own, without any data."""
    folder = tmp_path / "site" / "gltf_iri"
    folder.mkdir(parents=True)
    monkeypatch.setattr(resources, "__file__", str(folder / "resources.py"))
    return folder


def test_wheel_comes_before_checkout(package: Path) -> None:
    beside = package.parent / "shaders"
    beside.mkdir()
    assert resources.shader_root() == beside
    shipped = package / "_shipped" / "shaders"
    shipped.mkdir(parents=True)
    assert resources.shader_root() == shipped


@pytest.mark.parametrize("find", [resources.shader_root, resources.spec_root])
def test_lost_data_is_told_with_what_to_do(find: Callable[[], Path], package: Path) -> None:
    with pytest.raises(MissingCapabilityError, match="reinstall gltf-iri"):
        find()
