"""What a caller names in a word or a number."""

from __future__ import annotations

import pytest

from gltf_iri.errors import UsageError
from gltf_iri.scene.choose import choose_environment


@pytest.mark.parametrize("name", ["sunset", "", "missing/studio.hdr"])
def test_an_environment_that_is_not_there_is_answered_with_those_that_are(name):
    with pytest.raises(UsageError, match=r"name a \.hdr or \.exr file, studio, white or none"):
        choose_environment(name)


def test_what_is_made_here_goes_by_its_name():
    made = [choose_environment(name) for name in ("studio", "white")]
    assert [environment.name for environment in made if environment] == ["studio", "white"]
    assert choose_environment("none") is None
