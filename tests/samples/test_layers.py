"""Samples of layers hold the films that their READMEs state, and show their colour without the extension."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from gltf_iri.evaluation.layers import BraggLayer, LayerStack
from gltf_iri.evaluation.layers_single import LayersSingle
from gltf_iri.material.bragg import Bragg
from gltf_iri.material.ior import Ior
from gltf_iri.material.material import Material
from gltf_iri.optics.layer_stack import coating_transmittance
from gltf_iri.samples import bragg_cells, bragg_roughness, stacked_layers
from gltf_iri.samples.sample import Sample
from gltf_iri.scene.load import load

BRIGHTEST = 0.9  # where a fallback's reflectance is cut off: 1 would need an infinite index


def materials_of(sample: Sample, folder: Path) -> dict[str, Material]:
    (name, content) = next(iter(sample.files.items()))
    (folder / name).write_bytes(content)
    return {material.name: material for material in load(folder / name).materials}


def stack_of(bragg: Bragg, *, smooth: bool = False) -> LayerStack:
    layers = []
    for row in bragg.layers:
        assert row.period_min_nm == row.period_max_nm
        n1, period_nm = row.first_ior(bragg.host_ior), row.period_max_nm
        films_nm = row.fill * period_nm, (1.0 - row.fill) * period_nm
        alpha = 0.0 if smooth else row.roughness**2
        layers.append(BraggLayer.of(n1, row.ior_2, *films_nm, row.cells, alpha))
    return LayerStack.of(tuple(layers), bragg.host_ior)


@cache
def face_on(bragg: Bragg) -> np.ndarray:
    """Return what layers and coating mirror at normal incidence, every facet face on, (3,)."""
    stack, along = stack_of(bragg, smooth=True), np.ones(1)
    colours = LayersSingle(stack, "D65")
    layers = sum(colours.reflected(k, along, along, along)[0] for k in range(len(stack.layers)))
    through = float(coating_transmittance(bragg.host_ior, 1.0))
    return np.asarray(through**2 * layers + (1.0 - through))


@pytest.mark.parametrize("module", [stacked_layers, bragg_roughness, bragg_cells], ids=lambda m: m.__name__)
def test_surface_under_the_layers_has_their_colour_face_on(module, tmp_path: Path) -> None:
    """Masking, which roughness alone knows of, may take 0.03 of the light that a lower layer sends."""
    for name, material in materials_of(module.build(), tmp_path).items():
        tint = np.array(material.specular.color_factor)
        f0 = Ior().f0 * tint
        expected = np.clip(face_on(material.bragg), 0.0, BRIGHTEST)
        np.testing.assert_allclose(f0, expected, atol=0.03, err_msg=name)


def test_stacks_hold_the_same_two_layers_in_both_orders(tmp_path: Path) -> None:
    materials = materials_of(stacked_layers.build(), tmp_path)
    for base in stacked_layers.BASES:
        (a,), (b,) = (materials[f"{name}, on {base}"].bragg.layers for name in "AB")
        assert materials[f"A over B, on {base}"].bragg.layers == (a, b)
        assert materials[f"B over A, on {base}"].bragg.layers == (b, a)
    for name, films_nm in stacked_layers.FILMS_NM.items():
        (layer,) = stack_of(materials[f"{name}, on grey"].bragg).layers
        np.testing.assert_allclose((layer.d1_nm, layer.d2_nm), films_nm, atol=2e-4)
        np.testing.assert_allclose(layer.alpha, stacked_layers.ALPHA, atol=1e-6)


def test_balls_in_a_row_differ_in_cells_alone(tmp_path: Path) -> None:
    materials = materials_of(bragg_cells.build(), tmp_path)
    assert len(materials) == len(bragg_cells.HOSTS) * len(bragg_cells.CELLS)
    for where, host_ior in bragg_cells.HOSTS.items():
        row = [m.bragg for name, m in materials.items() if name.endswith(where)]
        assert tuple(bragg.layers[0].cells for bragg in row) == bragg_cells.CELLS
        assert {bragg.host_ior for bragg in row} == {host_ior}
        stacks = [stack_of(bragg) for bragg in row]
        assert len({tuple(map(float, (s.layers[0].d1_nm, s.layers[0].d2_nm))) for s in stacks}) == 1


def test_roughness_of_the_lowest_layer_rises_along_a_row(tmp_path: Path) -> None:
    materials = materials_of(bragg_roughness.build(), tmp_path)
    for kind in bragg_roughness.FALLBACK_F0:
        row = [m.bragg.layers for name, m in materials.items() if name.startswith(f"{kind},")]
        lowest = [layers[-1].roughness for layers in row]
        np.testing.assert_allclose(lowest, bragg_roughness.ROUGHNESSES, atol=1e-6)
    over = [m.bragg.layers[0] for name, m in materials.items() if name.startswith("thin over thick")]
    assert {layer.roughness for layer in over} == {bragg_roughness.UPPER_ROUGHNESS}
