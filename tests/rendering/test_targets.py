"""What a driver without memory leaves behind: a sentence, and nothing that stays allocated."""

from __future__ import annotations

from types import SimpleNamespace

import moderngl
import pytest

from gltf_iri.errors import MissingCapabilityError
from gltf_iri.rendering.targets import Targets


class Thing:
    def __init__(self):
        self.is_released = False

    def release(self):
        self.is_released = True


@pytest.mark.parametrize("successes", range(5))
def test_targets_that_find_no_room_give_back_what_they_took(successes):
    made = []

    def make(*_, **__):
        if len(made) == successes:
            raise moderngl.Error("out of memory")
        made.append(Thing())
        return made[-1]

    context = SimpleNamespace(renderbuffer=make, depth_renderbuffer=make, framebuffer=make)
    with pytest.raises(MissingCapabilityError, match="no room for 4 × 3 pixels"):
        Targets(context, (4, 3), samples=4, count=1)
    assert len(made) == successes
    assert all(thing.is_released for thing in made)
