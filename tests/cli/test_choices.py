"""The choices that the command line offers are those that there are."""

from __future__ import annotations

import click
import pytest

from gltf_iri.cli import compare, render
from gltf_iri.colour.spaces import WHITES
from gltf_iri.rendering.tonemap import TONE_MAPS


@pytest.mark.parametrize(
    ("command", "option", "known"),
    [(render.command, "tonemap", TONE_MAPS), (compare.command, "white", WHITES)],
    ids=["tone maps", "whites"],
)
def test_every_choice_exists_and_none_is_left_out(command, option, known):
    (found,) = (parameter for parameter in command.params if parameter.name == option)
    assert isinstance(found.type, click.Choice)
    assert set(found.type.choices) == set(known)
