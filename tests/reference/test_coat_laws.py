"""A coat on its own normal: what its lobe sends of a white sky is what it keeps from the surface below it."""

from __future__ import annotations

from dataclasses import fields

import numpy as np
import pytest
from numpy.testing import assert_allclose

from gltf_iri.reference.layers import clearcoat_lobe, clearcoat_reflectance
from gltf_iri.reference.surface import Surface

VECTORS = ("position", "normal", "view", "base_color", "emission", "dielectric_f0", "sheen_color")

# The base's normal is +Z; the coat's leans from it, so that the viewer sees the two at 45° and at 20°.
COAT = np.array([np.sin(np.radians(25.0)), 0.0, np.cos(np.radians(25.0))])
VIEW = np.array([np.sin(np.radians(45.0)), 0.0, np.cos(np.radians(45.0))])


def coated(count: int, roughness: float) -> Surface:
    values = {field.name: np.zeros(count) for field in fields(Surface)}
    values |= {name: np.zeros((count, 3)) for name in (*VECTORS, "anisotropy_tangent")}
    values |= {"normal": np.tile([0.0, 0.0, 1.0], (count, 1)), "view": np.tile(VIEW, (count, 1))}
    values |= {"n_dot_v": np.full(count, VIEW[2]), "clearcoat": np.full(count, 0.8)}
    values |= {
        "clearcoat_roughness": np.full(count, roughness),
        "clearcoat_normal": np.tile(COAT, (count, 1)),
    }
    return Surface(**values)


def over_the_coat(cosines: int = 400, turns: int = 800) -> tuple[np.ndarray, float]:
    """Directions of equal solid angle over the coat's hemisphere, and that solid angle."""
    z, turn = np.meshgrid((np.arange(cosines) + 0.5) / cosines, (np.arange(turns) + 0.5) / turns)
    sine, turn = np.sqrt(1.0 - z.ravel() ** 2), 2.0 * np.pi * turn.ravel()
    across = np.array([COAT[2], 0.0, -COAT[0]])
    axes = np.stack([across, np.cross(COAT, across), COAT])
    local = np.column_stack([sine * np.cos(turn), sine * np.sin(turn), z.ravel()])
    return local @ axes, 2.0 * np.pi / z.size


@pytest.mark.parametrize("roughness", [0.4, 0.6, 0.9])
def test_a_coat_keeps_from_below_what_its_own_lobe_sends_of_a_white_sky(roughness: float) -> None:
    """∫ f |cosθ| dω of the lobe is the share that is taken off below: same normal, same α = roughness²."""
    light, solid_angle = over_the_coat()
    sent = clearcoat_lobe(coated(len(light), roughness), light).sum() * solid_angle
    assert_allclose(sent, clearcoat_reflectance(coated(1, roughness))[0], rtol=1e-3)


@pytest.mark.parametrize("roughness", [0.2, 0.5])
def test_the_highlight_of_a_coat_is_as_wide_as_its_roughness_squared(roughness: float) -> None:
    """Where the half vector leans by atan α from the coat's normal, D is a quarter of (1 + α²)² of its top.

    Seen along the coat's normal, light and viewer nearly so, so that masking and Fresnel hardly change.
    """
    alpha = roughness**2
    lean = np.arctan(alpha)
    across = np.array([COAT[2], 0.0, -COAT[0]])
    top = 2.0 * (COAT @ VIEW) * COAT - VIEW
    # The half vector of top is Nc; turned about the axis across the plane of light and viewer it leans.
    half = np.cos(lean) * COAT + np.sin(lean) * np.cross(COAT, across)
    aside = 2.0 * (half @ VIEW) * half - VIEW
    surface = coated(2, roughness)
    lobe = clearcoat_lobe(surface, np.stack([top, aside]))

    def rest(light: np.ndarray) -> float:
        """All of the lobe but D: Schlick's F and V·(Nc·L), from Smith's Λ."""
        facing = [COAT @ light, COAT @ VIEW]
        tangents = [np.sqrt(1.0 - c * c) / c for c in facing]
        shadowed = sum(0.5 * (np.sqrt(1.0 + (alpha * t) ** 2) - 1.0) for t in tangents)
        middle = (light + VIEW) / np.linalg.norm(light + VIEW)
        fresnel = 0.04 + 0.96 * (1.0 - middle @ VIEW) ** 5
        return float(fresnel / ((1.0 + shadowed) * 4.0 * facing[1]))

    facets = lobe / [rest(top), rest(aside)]
    assert_allclose(facets[0], 0.8 / (np.pi * alpha**2), rtol=1e-9)
    assert_allclose(facets[1] / facets[0], 0.25 * (1.0 + alpha**2) ** 2, rtol=1e-9)
