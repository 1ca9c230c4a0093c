"""A film drawn with the spread of its thickness is what Python makes of it, near the mean of the truth."""

from __future__ import annotations

from gltf_iri.bench.fine_film import fine_film
from gltf_iri.comparison.run import compare
from gltf_iri.planning.decide import plan_materials
from gltf_iri.rendering.render import Renderer
from gltf_iri.scene.environment import white
from gltf_iri.tolerances import GLSL_PIXEL_RELATIVE


def test_glsl_averages_over_thicknesses_as_python_and_the_truth_do(gl_context, record_property):
    renderer = Renderer(gl_context)
    with fine_film(128) as model:
        scene = model.scene()
        plans = plan_materials(model.materials, method="fourier")
        comparison = compare(renderer, model, scene, plans, scene.cameras[0], white(), size=(24, 24))
    renderer.release()
    (result,) = comparison.materials
    agreement = result.glsl_vs_python.all
    record_property("measured", f"GLSL − Python, a spread of thickness: {agreement.max_relative}")
    assert agreement.pixels > 300
    assert agreement.max_relative <= GLSL_PIXEL_RELATIVE
    assert result.method_vs_truth.delta_e_max < 0.1
