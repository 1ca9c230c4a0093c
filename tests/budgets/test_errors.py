"""What errors are measured beside: the bare surface, the strongest film, and what OpenGL resolves."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.budgets.candidates import resolves_in_glsl
from gltf_iri.budgets.choose import Asked, choose_way
from gltf_iri.budgets.errors import FilmErrors
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Film, base_from_f0
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.planning.reach import Reach, Span

NONE = Span.at(0.0)
GLASS = (Span.at(0.01),) * 3


def glass(thickness_nm: Span, factor: Span) -> Reach:
    return Reach(1.5, factor, thickness_nm, NONE, NONE, GLASS, GLASS, True, True)


@pytest.mark.parametrize("weight", [1.0, 0.25])
def test_what_is_left_without_a_film_reflects_its_specular_weight_at_grazing_angles(weight: float) -> None:
    g = np.random.default_rng(6)
    cosine, thickness_nm = g.uniform(size=4000), g.uniform(100.0, 300.0, 4000)
    film = evaluate("spectral", Film.of(cosine, thickness_nm, 1.5, base_from_f0(np.full(3, 0.01)))).rgb
    bare = np.repeat(0.01 + (weight - 0.01) * (1.0 - cosine[:, None]) ** 5, 3, axis=1)
    # The film counts by its greatest factor, whatever else its texture holds.
    expected = np.percentile(delta_e_2000(bare, 0.6 * bare + 0.4 * film), 95)
    reach = glass(Span(100.0, 300.0), Span(0.0, 0.4))
    errors = FilmErrors(reach, has_image_light=False, bare_at_grazing=weight)
    assert 0.97 * expected < errors.without_film(np.inf).delta_e < 1.25 * expected


def test_the_truth_is_no_way_where_its_twin_does_not_resolve_the_fringes() -> None:
    near, far = (glass(Span.at(nm), Span.at(1.0)) for nm in (33_500.0, 35_500.0))
    assert resolves_in_glsl(near)
    assert not resolves_in_glsl(far)
    asked = Asked(1e-3, 1e6, "glsl", has_tables=False)
    assert choose_way(near, asked, "it").way.method == "spectral"
    with pytest.raises(UsageError, match="No way keeps"):
        choose_way(far, asked, "it")
