"""The layers of a glTF material: their numbers are the file's, and its surface is that of the pictures."""

from __future__ import annotations

from dataclasses import fields, replace

import numpy as np
import pytest

from gltf_iri.errors import UsageError
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.layers import Pose
from gltf_iri.evaluation.material_layers import in_material, material_layers
from gltf_iri.evaluation.material_surface import surface_albedo, surface_brdf
from gltf_iri.evaluation.stack_evaluation import evaluate_stack
from gltf_iri.material.bragg import Bragg, MirrorLayer
from gltf_iri.material.ior import Ior
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.specular import Specular
from gltf_iri.material.texture import TextureInfo
from gltf_iri.material.transmission import Transmission
from gltf_iri.material.unlit import Unlit
from gltf_iri.planning.decide import plan_material
from gltf_iri.reference.film_on import FilmOn
from gltf_iri.reference.layers_direct import DirectLayers
from gltf_iri.reference.lobes import evaluate_lobes
from gltf_iri.reference.surface import Surface

COLOUR = (0.8, 0.5, 0.2)
OUTER = MirrorLayer(ior_2=1.5, period_min_nm=200.0, period_max_nm=260.0, fill=0.4, cells=3, roughness=0.6)
INNER = MirrorLayer(ior_2=1.6, period_max_nm=300.0, cells=2, roughness=0.5)
BRAGG = Bragg(factor=0.6, layers=(OUTER, INNER), period_texture=TextureInfo(0))


def made(metalness: float = 0.25, **rest: object) -> Material:
    pbr = MetallicRoughness((*COLOUR, 1.0), metallic_factor=metalness, roughness_factor=0.55)
    return Material(pbr=pbr, **({"bragg": BRAGG} | rest))


def test_the_stack_is_what_the_file_says() -> None:
    material = made(transmission=Transmission(factor=0.3))
    found = material_layers(material, plan_material(material, 0), 0.25)
    assert found.period_nm == (215.0, 262.5)
    assert found.period_range_nm == ((200.0, 260.0), (250.0, 300.0))
    first, second = found.stack.layers
    assert (float(first.d1_nm), float(first.d2_nm)) == pytest.approx((86.0, 129.0))
    assert (float(second.d1_nm), int(second.cells), float(second.alpha)) == (131.25, 2, 0.25)
    base = found.stack.base
    np.testing.assert_allclose(base.diffuse, 0.75 * 0.7 * np.array(COLOUR))
    np.testing.assert_allclose(base.metal_f0, COLOUR)
    assert (float(base.metal_share), float(base.metal_alpha)) == (0.25, pytest.approx(0.55**2))
    np.testing.assert_allclose(found.transmission, 0.75 * 0.3 * np.array(COLOUR))
    assert found.factor == 0.6


def test_without_a_value_periods_are_their_maxima() -> None:
    material = made()
    plan = plan_material(material, 0)
    assert material_layers(material, plan).period_nm == material_layers(material, plan, 1.0).period_nm
    assert material_layers(material, plan).period_nm == (260.0, 300.0)


def test_smooth_layers_stay_smooth() -> None:
    material = made(bragg=Bragg(1.0, layers=(replace(OUTER, roughness=0.0),)))
    (layer,) = material_layers(material, plan_material(material, 0)).stack.layers
    assert float(layer.alpha) == 0.0


@pytest.mark.parametrize(
    ("material", "says"),
    [
        (Material(), "no EXT_materials_bragg"),
        (made(bragg=Bragg()), "the factor is 0"),
        (made(iridescence=Iridescence(factor=1.0)), "excludes it"),
        (made(bragg=Bragg(1.0, layers=(MirrorLayer(ior_1=1.2, ior_2=1.5), OUTER))), "bends light"),
        (made(unlit=Unlit()), "the material is unlit"),
    ],
)
def test_what_is_not_drawn_is_not_evaluated_and_says_why(material: Material, says: str) -> None:
    with pytest.raises(UsageError, match=f"nothing to evaluate: no layers: .*{says}"):
        material_layers(material, plan_material(material, 0))


@pytest.mark.parametrize(
    ("bragg", "value", "says"),
    [
        *((BRAGG, value, "from 0 to 1") for value in (1.5, -0.1, np.nan)),
        (Bragg(1.0, layers=(OUTER,)), 0.5, "No period"),
    ],
)
def test_values_that_no_texture_gives_are_refused(bragg: Bragg, value: float, says: str) -> None:
    material = made(bragg=bragg)
    with pytest.raises(UsageError, match=says):
        material_layers(material, plan_material(material, 0), value)


MATERIALS = {
    "mixed": made(),
    "dielectric": made(0.0, ior=Ior(1.8), specular=Specular(factor=0.7, color_factor=(1.0, 0.6, 0.3))),
    "metal": made(1.0),
    "half let through": made(0.0, transmission=Transmission(factor=0.4)),
}


@pytest.mark.parametrize("name", MATERIALS)
def test_a_material_s_brdf_is_what_the_renderer_s_twin_shades_with(name: str) -> None:
    material = MATERIALS[name]
    plan, g = plan_material(material, 0), np.random.default_rng(4)
    cos_o, cos_i, turn = g.uniform(0.1, 1.0, 9), 0.6, 0.3
    sin_o, sin_i = np.sqrt(1.0 - cos_o**2), np.sqrt(1.0 - cos_i**2)
    view = np.column_stack([sin_o, 0.0 * cos_o, cos_o])
    light = np.tile([sin_i * turn, sin_i * np.sqrt(1.0 - turn**2), cos_i], (9, 1))
    found = material_layers(material, plan)
    stack = evaluate_stack("layers-bands", found.stack, cos_o, (cos_i, turn), parameters={"bands": 4})
    both = in_material(material, plan, found, stack, cos_o, (cos_i, turn))

    def layers(_: object) -> DirectLayers:
        return DirectLayers(plan.layers, layer_colours("layers-bands", found.stack, parameters={"bands": 4}))

    surface = points(material, view)
    expected = evaluate_lobes(surface, light, FilmOn(surface, 1.3, no_film, layers), plan) / cos_i
    np.testing.assert_allclose(both.rgb, expected, rtol=1e-10)
    assert not np.allclose(both.plain, both.rgb, rtol=1e-3)


def no_film(*_: object) -> None:
    raise AssertionError("there is no film")


def points(material: Material, view: np.ndarray) -> Surface:
    """Points that face +z, seen from `view` (n, 3)."""
    count, specular = len(view), material.specular or Specular()
    of_axes = {"position", "normal", "view", "base_color", "emission", "dielectric_f0"}
    of_axes |= {"anisotropy_tangent", "sheen_color", "clearcoat_normal"}
    values = {f.name: np.zeros((count, 3) if f.name in of_axes else count) for f in fields(Surface)}
    f0 = (material.ior or Ior()).f0 * np.array(specular.color_factor)
    values |= {
        "view": view,
        "n_dot_v": view[:, 2],
        **{name: np.tile([0.0, 0.0, 1.0], (count, 1)) for name in ("normal", "clearcoat_normal")},
        "base_color": np.tile(COLOUR, (count, 1)),
        "dielectric_f0": np.tile(f0, (count, 1)),
        "metallic": np.full(count, material.pbr.metallic_factor),
        "perceptual_roughness": np.full(count, 0.55),
        "alpha_roughness": np.full(count, 0.55**2),
        "specular_weight": np.full(count, specular.factor),
        "occlusion": np.ones(count),
        "bragg_factor": np.full(count, 0.6),
        "bragg_period_texel": np.ones(count),
        "transmission": np.full(count, material.transmission.factor if material.transmission else 0.0),
    }
    return Surface(**values)


@pytest.mark.parametrize("name", MATERIALS)
def test_what_a_surface_sends_back_is_the_sum_of_its_brdf(name: str) -> None:
    material = MATERIALS[name]
    plan, cosines = plan_material(material, 0), np.array([1.0, 0.5, 0.1])
    nodes, weights = np.polynomial.legendre.leggauss(200)
    cos_o, over_cos = 0.5 * (nodes + 1.0), 0.5 * weights
    turn, over_turn = 0.5 * np.pi * (nodes + 1.0), np.pi * weights  # half a turn counts twice
    pose = Pose.of(cosines[:, None, None], cos_o[:, None], np.cos(turn))
    sent = surface_brdf(material, plan, pose) * (cos_o * over_cos)[:, None, None] * over_turn[:, None]
    np.testing.assert_allclose(surface_albedo(material, plan, cosines), sent.sum((1, 2)), rtol=0, atol=2e-5)


def test_a_white_mirror_like_metal_sends_all_back() -> None:
    pbr = MetallicRoughness((1.0, 1.0, 1.0, 1.0), metallic_factor=1.0, roughness_factor=0.0)
    material = Material(pbr=pbr)
    sent = surface_albedo(material, plan_material(material, 0), [1.0, 0.5, 0.2])
    np.testing.assert_allclose(sent, 1.0, rtol=0, atol=1e-4)


def test_grazing_light_and_viewer_leave_numbers() -> None:
    material = made()
    plan = plan_material(material, 0)
    assert np.all(np.isfinite(surface_brdf(material, plan, Pose.of(0.0, 0.0, 1.0))))
    assert np.all(np.isfinite(surface_albedo(material, plan, 0.0)))
