"""The film of a glTF material: base, factor, metalness and the two layerings."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Film, base_from_f0, base_from_ior
from gltf_iri.evaluation.material_film import evaluate_material
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.material.ior import Ior
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.specular import Specular
from gltf_iri.material.texture import TextureInfo
from gltf_iri.optics.fresnel import f_schlick
from gltf_iri.planning.decide import plan_material

COSINES = np.linspace(0.1, 1.0, 5)
FILM = Iridescence(factor=1.0, film_ior=1.8, thickness_max_nm=350.0)
COLOUR = (0.9, 0.6, 0.3)


def material(metalness: float, **rest: object) -> Material:
    pbr = MetallicRoughness(base_color_factor=(*COLOUR, 1.0), metallic_factor=metalness)
    return Material(pbr=pbr, **({"iridescence": FILM} | rest))


@pytest.mark.parametrize("method", ["khr", "khr-guarded", "spectral"])
@pytest.mark.parametrize(("metalness", "base"), [(1.0, base_from_f0(COLOUR)), (0.0, base_from_ior(1.5))])
def test_metal_and_dielectric_give_the_film_its_base(method: str, metalness: float, base: object) -> None:
    subject = material(metalness)
    done = evaluate_material(subject, plan_material(subject, 0, method=method), COSINES)
    expected = evaluate(method, Film.of(COSINES, 350.0, 1.8, base)).rgb
    assert np.abs(done.film.rgb - expected).max() <= 1e-9
    assert np.abs(done.layer.specular - expected).max() <= 1e-9


def test_half_a_metal_lies_halfway() -> None:
    parts = [
        evaluate_material(subject, plan_material(subject, 0), COSINES).film.rgb
        for subject in (material(0.0), material(0.5), material(1.0))
    ]
    assert np.abs(parts[1] - 0.5 * (parts[0] + parts[2])).max() <= 1e-12


def test_undefined_metal_does_not_touch_a_pure_dielectric() -> None:
    pbr = MetallicRoughness(base_color_factor=(0.9999, 0.9999, 0.9999, 1.0), metallic_factor=0.0)
    subject = Material(pbr=pbr, iridescence=FILM)
    done = evaluate_material(subject, plan_material(subject, 0, method="khr"), COSINES)
    assert np.all(np.isfinite(done.film.rgb))
    assert not any("divides by zero" in case for case in done.film.undefined)


def test_weight_below_the_film_is_what_its_brightest_channel_leaves() -> None:
    subject = material(0.0)
    layer = evaluate_material(subject, plan_material(subject, 0), COSINES).layer
    assert np.abs(layer.base_weight - (1.0 - layer.specular.max(axis=-1))).max() <= 1e-12


def test_small_factor_approaches_the_plain_material() -> None:
    thin = Iridescence(factor=1e-9, film_ior=1.8, thickness_max_nm=350.0)
    subject = material(0.0, iridescence=thin, ior=Ior(1.33), specular=Specular(factor=0.5))
    layer = evaluate_material(subject, plan_material(subject, 0), COSINES).layer
    plain = 0.5 * f_schlick((0.33 / 2.33) ** 2, COSINES)
    assert np.abs(layer.specular - plain[:, None]).max() <= 1e-8


def test_given_thickness_replaces_the_maximum() -> None:
    subject = material(0.0)
    plan = plan_material(subject, 0)
    assert evaluate_material(subject, plan, COSINES).thickness_nm == 350.0
    other = evaluate_material(subject, plan, COSINES, thickness_nm=200.0)
    expected = evaluate("khr-guarded", Film.of(COSINES, 200.0, 1.8, base_from_ior(1.5))).rgb
    assert np.abs(other.film.rgb - expected).max() <= 1e-12


def test_the_range_is_the_textures_also_where_the_minimum_is_the_larger() -> None:
    falling = Iridescence(factor=0.5, thickness_min_nm=500.0, thickness_max_nm=200.0)
    textured = replace(falling, thickness_texture=TextureInfo(texture=0))
    for film, expected in ((falling, (200.0, 200.0)), (textured, (500.0, 200.0))):
        subject = material(0.0, iridescence=film)
        done = evaluate_material(subject, plan_material(subject, 0), COSINES)
        assert done.thickness_range_nm == expected
        assert (done.thickness_nm, done.factor) == (200.0, 0.5)


def test_material_without_film_is_refused() -> None:
    subject = material(0.0, iridescence=None)
    with pytest.raises(UsageError, match="no film"):
        evaluate_material(subject, plan_material(subject, 3), COSINES)


def test_a_metal_hides_its_share_of_what_lies_below() -> None:
    layers = [
        evaluate_material(subject, plan_material(subject, 0), COSINES).layer
        for subject in (material(0.0), material(0.25), material(1.0))
    ]
    assert np.abs(layers[1].base_weight - 0.75 * layers[0].base_weight).max() <= 1e-12
    assert np.array_equal(layers[2].base_weight, np.zeros(COSINES.shape))


def test_specular_weight_and_tint_belong_to_the_base_under_the_film() -> None:
    subject = material(0.0, specular=Specular(factor=0.5, color_factor=(1.0, 0.5, 0.25)))
    done = evaluate_material(subject, plan_material(subject, 0), COSINES)
    base = base_from_f0(0.5 * 0.04 * np.array([1.0, 0.5, 0.25]))
    assert (
        np.abs(done.film.rgb - evaluate("khr-guarded", Film.of(COSINES, 350.0, 1.8, base)).rgb).max() <= 1e-12
    )
