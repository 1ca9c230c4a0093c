"""Films out of tables: GLSL looks up what Python looks up, and pictures drawn with tables are the film's."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest

from gltf_iri.baking.baked import BakedTable
from gltf_iri.baking.fill import bake
from gltf_iri.baking.lookup import look_up
from gltf_iri.errors import MissingCapabilityError, UsageError
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.planning.decide import plan_material
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.film_table import FilmTable, TableAxis
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.planning.permutation import permutation
from gltf_iri.planning.reach import Span
from gltf_iri.planning.way import Way
from gltf_iri.rendering.film_tables import checked_tables, film_table_texture, film_table_uniforms
from gltf_iri.rendering.timed_calls import TimedCall, call_colours
from gltf_iri.scene.model import Light

FILMED = {"dielectric": Effect.DIELECTRIC, "metal": Effect.METAL}
SPANS = {
    "cos_theta": Span(0.0, 1.0),
    "thickness_nm": Span(150.0, 420.0),
    "base_f0": Span(0.1, 0.9),
    "roughness": Span(0.0, 0.7),
    "spread_nm": Span(0.0, 40.0),
}
NODES = {"cos_theta": 17, "thickness_nm": 9, "base_f0": 5, "roughness": 4, "spread_nm": 3}
OTHERS = ("thickness_nm", "base_f0", "roughness", "spread_nm")
EVERY_SET = [c for count in range(4) for c in combinations(OTHERS, count)]

LOOK_UP = """
vec3 looked_up(vec3 base_f0, float thickness_nm, float std_nm, float cosine, float roughness) {{
    Surface s;
    s.iridescence_thickness_nm = thickness_nm;
    s.iridescence_thickness_std_nm = std_nm;
    return {lobe}_table(s, base_f0, Lobe(cosine, cosine, roughness, 1.0, 0.0));
}}"""


def filled_at_random(quantities, lobe, texel="f4", spans=SPANS, nodes=NODES):
    axes = tuple(TableAxis(q, spans[q], nodes[q]) for q in ("cos_theta", *quantities))
    table = FilmTable(lobe, 1.4, 300.0, (0.04,) * 3, axes, texel, 0.0)
    texels = np.random.default_rng(len(quantities)).random((*table.shape, 3))
    return BakedTable(table, texels.astype(texel), "D65", 0.0, is_cached=False)


def points(count=4000, spans=SPANS):
    """Arguments inside of the spans and beyond both ends; every second base is grey."""
    rng = np.random.default_rng(8)

    def around(span):
        reach = 0.2 * (span.high - span.low)
        return rng.uniform(max(span.low - reach, 0.0), span.high + reach, count).astype(np.float32)

    base = np.stack([around(spans["base_f0"]) for _ in range(3)], axis=-1)
    base[::2, 1:] = base[::2, :1]
    cosine = rng.random(count).astype(np.float32)
    return (
        base,
        *(around(spans[q]) for q in ("thickness_nm", "spread_nm")),
        cosine,
        around(spans["roughness"]),
    )


def by_glsl(context, baked, arguments):
    lobe = baked.table.lobe
    effects = (
        Effect.IRIDESCENCE,
        Effect.IRIDESCENCE_THICKNESS_TEXTURE,
        Effect.IRIDESCENCE_THICKNESS_SPREAD,
        FILMED[lobe],
    )
    plan = MaterialPlan(0, "", effects, "spectral", "", "core", way=Way("spectral", tables=(baked.table,)))
    texture = film_table_texture(context, baked)
    call = TimedCall(
        "a look-up",
        ('#include "lighting/film_table.glsl"', *LOOK_UP.format(lobe=lobe).splitlines()),
        "looked_up(a0, a1, a2, a3, a4)",
        ("vec3", "float", "float", "float", "float"),
        arguments,
        textures={f"u_{lobe}_table": texture},
        uniforms=film_table_uniforms(baked.table),
        defines=permutation(plan, (), ()),
    )
    try:
        return call_colours(context, call, len(arguments[0]))
    finally:
        texture.release()


def by_python(baked, arguments):
    base, thickness_nm, std_nm, cosine, roughness = (np.asarray(a, np.float64) for a in arguments)
    return look_up(baked, cosine, thickness_nm, base, roughness=roughness, spread_nm=std_nm)


def filter_error(context):
    """Nodes differ by at most 1 here, and graphics cards filter with weights of eight bits."""
    return 2e-6 if "llvmpipe" in context.info["GL_RENDERER"] else 1.0 / 256.0


@pytest.mark.parametrize("lobe", ["dielectric", "metal"])
@pytest.mark.parametrize("quantities", EVERY_SET, ids=lambda q: "+".join(q) or "cos_theta")
def test_glsl_looks_up_what_python_looks_up(gl_context, quantities, lobe):
    baked = filled_at_random(quantities, lobe)
    arguments = points()
    np.testing.assert_allclose(
        by_glsl(gl_context, baked, arguments), by_python(baked, arguments), atol=filter_error(gl_context)
    )


def test_half_precision_texels_are_filtered_in_single_precision(gl_context):
    baked = filled_at_random(("thickness_nm",), "metal", "f2")
    arguments = points()
    np.testing.assert_allclose(
        by_glsl(gl_context, baked, arguments), by_python(baked, arguments), atol=filter_error(gl_context)
    )


@pytest.mark.parametrize(
    "span",
    [Span.at(300.0), Span(300.0, 300.0000001), Span(0.0, 1e12), Span(0.0, 1e-30)],
    ids=["one value", "less than float32 tells", "all thicknesses", "next to nothing"],
)
@pytest.mark.parametrize("quantities", [("thickness_nm",), ("thickness_nm", "roughness", "spread_nm")])
def test_absurd_spans_give_colours_of_the_table(gl_context, quantities, span):
    spans = {**SPANS, "thickness_nm": span}
    nodes = {**NODES, "thickness_nm": 1 if span.is_point else 5}
    baked = filled_at_random(quantities, "metal", spans=spans, nodes=nodes)
    base, _, std_nm, cosine, roughness = points(spans=SPANS)
    thickness_nm = np.resize(np.float32([0.0, 100.0, 300.0, 1e6, 1e12]), len(cosine))
    arguments = base, thickness_nm, std_nm, cosine, roughness
    found = by_glsl(gl_context, baked, arguments)
    np.testing.assert_allclose(found, by_python(baked, arguments), atol=filter_error(gl_context))


def test_a_table_larger_than_opengl_takes_is_refused_in_words(gl_context):
    limit = gl_context.info["GL_MAX_3D_TEXTURE_SIZE"]
    nodes = {**NODES, "cos_theta": 2, "base_f0": 2, "thickness_nm": limit + 1}
    baked = filled_at_random(("thickness_nm", "base_f0"), "metal", nodes=nodes)
    with pytest.raises(
        MissingCapabilityError, match=rf"2 × {limit + 1} × 2 nodes .* this OpenGL takes {limit}"
    ):
        film_table_texture(gl_context, baked)


MATERIAL = Material(
    iridescence=Iridescence(factor=0.8, film_ior=1.4, thickness_max_nm=420.0),
    pbr=MetallicRoughness(base_color_factor=(0.9, 0.6, 0.3, 1.0), metallic_factor=0.6, roughness_factor=0.5),
)


def with_tables(material, nodes=257, *, roughness=False):
    """The plan of `material` by fine tables over both lobes, and these."""
    bases = {"dielectric": (0.04,) * 3, "metal": material.pbr.base_color_factor[:3]}
    axes = [TableAxis("cos_theta", Span(0.0, 1.0), nodes)]
    if roughness:
        axes.append(TableAxis("roughness", Span(0.0, material.pbr.roughness_factor), 9))
    film = material.iridescence
    tables = [
        FilmTable(lobe, film.film_ior, film.thickness_max_nm, base, tuple(axes), "f4", 0.0)
        for lobe, base in bases.items()
    ]
    plan = plan_material(material, 0, way=Way("spectral", tables=tuple(tables)), way_reason="for a test")
    return plan, {0: {table.lobe: bake(table) for table in tables}}


def sun():
    return Light("", "directional", (1.0, 0.9, 0.8), 3.0, np.zeros(3), np.array([0.4, -0.3, -0.9]))


def test_under_punctual_light_a_table_of_the_truth_draws_the_truth(stage, props):
    plan, tables = with_tables(MATERIAL)
    options = {"lights": [sun()], "samples": 0}
    direct = stage.draw(props.sphere(), MATERIAL, method="spectral", **options).rgba
    looked_up = stage.draw(props.sphere(), MATERIAL, plans=[plan], tables=tables, **options).rgba
    assert direct[..., :3].max() > 0.5
    # Between nodes h²/8 · |F″|, h = 1/256, |F″| up to some 20.
    np.testing.assert_allclose(looked_up, direct, atol=5e-5 * direct.max())


def test_a_table_that_is_missing_or_another_is_an_error(stage, props):
    plan, tables = with_tables(MATERIAL, 9)
    one = {0: {"metal": tables[0]["metal"]}}
    with pytest.raises(UsageError, match="film over its dielectric under D65, and none was given"):
        stage.draw(props.sphere(), MATERIAL, plans=[plan], tables=one)
    other = replace(tables[0]["metal"], table=replace(tables[0]["metal"].table, film_ior=1.5))
    with pytest.raises(UsageError, match="film over its metal under D65, and another was given"):
        checked_tables(plan, {0: {**tables[0], "metal": other}}, "D65")
    with pytest.raises(UsageError, match="film over its dielectric under E, and another was given"):
        checked_tables(plan, tables, "E")
