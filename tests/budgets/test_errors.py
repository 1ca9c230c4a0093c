"""What errors are measured beside: the bare surface, the strongest film, and what OpenGL resolves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gltf_iri.budgets.candidates import resolves_in_glsl
from gltf_iri.budgets.choose import Asked, choose_way
from gltf_iri.budgets.errors import FilmErrors
from gltf_iri.budgets.plans import plan_within
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Film, base_from_f0
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material
from gltf_iri.material.specular import Specular
from gltf_iri.material.texture import TextureInfo
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


def test_a_film_is_kept_where_nobody_knows_what_the_bare_surface_reflects() -> None:
    thin = Iridescence(factor=1.0, film_ior=1.4, thickness_max_nm=0.2)
    asked = Asked(5.0, 1e6, "glsl")
    uniform, painted = (
        plan_within(Material(specular=Specular(0.9, texture), iridescence=thin), 0, asked)
        for texture in (None, TextureInfo(0))
    )
    assert uniform.method is None
    assert painted.method is not None


def test_tables_answer_for_the_image_light_that_is_asked_for() -> None:
    rough = replace(glass(Span.at(400.0), Span.at(1.0)), roughness=Span.at(0.6))
    for has_image_light in (False, True):
        way = choose_way(rough, Asked(0.3, 1e9, "glsl", has_image_light=has_image_light), "it").way
        assert [table.axis("roughness") is not None for table in way.tables] == [has_image_light]
