"""`gltf-iri evaluate FILE`: the film or the Bragg layers of one of a file's materials."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from gltf_iri.backends import choose_backend
from gltf_iri.cli.common import material_label, note, print_table
from gltf_iri.cli.evaluate_layers import evaluated, print_layers, stack_json
from gltf_iri.cli.evaluate_subject import How, evaluation_json

if TYPE_CHECKING:
    from collections.abc import Mapping

    from gltf_iri.material.material import Material
    from gltf_iri.planning.material_plan import MaterialPlan
    from gltf_iri.planning.way import Way

__all__ = ["chosen_material", "from_file", "print_material_layers"]

# Textures that make another base under the film or the layers, and that of the layers' factor; thicknesses
# and periods have their place in the title.
_TEXTURES = frozenset(
    {
        *("base-color-texture", "metallic-roughness-texture", "transmission-texture"),
        *("specular-texture", "specular-color-texture", "bragg-texture"),
    }
)

# Of these, what acts on no layer but on what layers are mixed with.
_TEXTURES_OF_THE_MIX = frozenset({"specular-texture", "specular-color-texture", "bragg-texture"})

_LISTED_MAX = 8  # materials that an error names; `plan` lists them all


def from_file(
    file: Path,
    name: str | None,
    cosines: tuple[float, ...],
    how: How,
    layered: bool,
    given: dict[str, Any],
) -> dict[str, Any]:
    """Return what `evaluate --json` prints of the material of `file` called `name`.

    Layers where the plan draws some, else its film: a material that has both has no layers (the reason stands
    in "not_drawn").
    """
    from gltf_iri.errors import UsageError
    from gltf_iri.planning.decide import plan_material
    from gltf_iri.scene.load import load

    for option, value in given.items():
        if value is not None and option not in ("thickness", "light", "period_texel"):
            named = "host" if option == "host_ior" else option.replace("_", "-")
            raise click.UsageError(f"FILE's material decides --{named}; leave it out")
    materials = load(file).materials
    index = chosen_material(materials, name, file, has_layers=True)
    material, plan = materials[index], plan_material(materials[index], index)
    if material.bragg is None and material.iridescence is None:
        label = material_label(index, material.name)
        raise UsageError(f"Material {label} has neither film nor layers; `plan` tells what it has.")
    if plan.layers is not None or (material.bragg is not None and material.iridescence is None):
        if given["thickness"] is not None:
            raise click.UsageError(
                "layers have periods and no --thickness: --period-texel places them along their texture"
            )
        result = _of_layers(material, plan, cosines, how, layered, given)
    else:
        for option in ("light", "period_texel"):
            if given[option] is not None:
                raise click.UsageError(
                    f"--{option.replace('_', '-')} is for layers, and this material has none; leave it out"
                )
        result = _of_film(material, plan, cosines, how, layered, given["thickness"])
    asked = _TEXTURES if plan.layers is None or layered else _TEXTURES - _TEXTURES_OF_THE_MIX
    result["textures_left_out"] = [e.value for e in plan.effects if e.value in asked]
    return result | {"not_drawn": dict(plan.not_drawn)}


def _of_film(
    material: Material,
    plan: MaterialPlan,
    cosines: tuple[float, ...],
    how: How,
    layered: bool,
    thickness_nm: float | None,
) -> dict[str, Any]:
    from gltf_iri.evaluation.material_film import evaluate_material
    from gltf_iri.planning.method import find_method

    way = None
    if how.method is not None and plan.method is not None:
        plan = replace(plan, method=find_method(how.method, "film").name)
    if how.budget is not None and plan.method is not None:
        way = _way_of(material, plan.index, len(cosines), how, thickness_nm)
        plan = replace(plan, method=way.method)
    done = evaluate_material(
        material,
        plan,
        cosines,
        thickness_nm=thickness_nm,
        white=how.white,
        backend=how.backend,
        parameters=how.parameters if way is None else way.parameters,
    )
    film = done.film
    if way is not None:
        film = replace(film, delta_e=way.delta_e, ns_per_colour=way.ns_per_colour)
    result = evaluation_json(cosines, film)
    result |= {"material": plan.name, "index": plan.index, "thickness_nm": done.thickness_nm}
    result |= {"thickness_range_nm": done.thickness_range_nm, "factor": done.factor}
    if layered:
        result |= {"specular": done.layer.specular, "base_weight": done.layer.base_weight}
    return result


def _way_of(material: Material, index: int, count: int, how: How, thickness_nm: float | None) -> Way:
    """Return the cheapest method within the budget, at all angles, for the material without its textures."""
    from gltf_iri.arrays.films import films_of_material, reach_of_films
    from gltf_iri.budgets.choose import Asked, choose_way
    from gltf_iri.errors import UsageError

    label = f"material '{material_label(index, material.name)}'"
    reach = reach_of_films(films_of_material(material, index, ("cos",), thickness_nm), {})
    device = choose_backend(how.backend, count, ("numpy", "numba"), "budget")
    asked = Asked(how.budget or 0.0, count, device, how.white, is_film_needed=True, has_tables=False)
    if reach is None:
        raise UsageError(f"A budget does not know what lies under the film of {label}; name a --method.")
    return choose_way(reach, asked, label).way


def _of_layers(
    material: Material,
    plan: MaterialPlan,
    cosines: tuple[float, ...],
    how: How,
    layered: bool,
    given: Mapping[str, Any],
) -> dict[str, Any]:
    """Return the layers at factor 1; `layered` adds the surface without them, and both by the factor."""
    from gltf_iri.evaluation.material_layers import in_material, material_layers

    found, light = material_layers(material, plan, given["period_texel"]), given["light"]
    done = evaluated(found.stack, cosines, how, light)
    base = found.stack.base
    result = stack_json(cosines, light, done) | {
        "material": plan.name,
        "index": plan.index,
        "factor": found.factor,
        "period_texel": found.period_texel,
        "host_ior": float(found.stack.host_ior),
        "layers": [
            {
                "source": source,
                "n1": float(layer.n1),
                "n2": float(layer.n2),
                "period_nm": nm,
                "period_range_nm": ends,
                "d1_nm": float(layer.d1_nm),
                "d2_nm": float(layer.d2_nm),
                "cells": int(layer.cells),
                "alpha": float(layer.alpha),
            }
            for layer, source, nm, ends in zip(
                found.stack.layers, found.sources, found.period_nm, found.period_range_nm, strict=True
            )
        ],
        "base": {
            "diffuse": base.diffuse,
            "metal_f0": base.metal_f0,
            "metal_share": float(base.metal_share),
            "metal_alpha": float(base.metal_alpha),
            "transmission": found.transmission,
        },
        "simpler": [] if plan.layers is None else list(plan.layers.simpler),
    }
    if layered:
        both = in_material(material, plan, found, done, cosines, light)
        result |= {"plain": both.plain, "layered": both.rgb}
    return result


def print_material_layers(result: Mapping[str, Any]) -> None:
    """Print `from_file`'s result of layers for people: their colours, and what they are."""
    label = material_label(result["index"], result["material"])
    print_layers(result, more=f"; material {label}, factor {result['factor']:g}")
    rows = []
    for layer in result["layers"]:
        low, high = layer["period_range_nm"]
        of = "" if low == high else f" of {low:g} to {high:g}"
        films = f"{layer['d1_nm']:.6g} + {layer['d2_nm']:.6g}"
        rows.append(
            (
                *(layer["source"], f"{layer['n1']:g}", f"{layer['n2']:g}", f"{layer['period_nm']:g}{of}"),
                *(films, layer["cells"], f"{layer['alpha']:.6g}"),
            )
        )
    title = f"Layers in a host of index {result['host_ior']:g}, outermost first, period texel "
    columns = ("layer", "n1", "n2", "period nm", "d1 + d2 nm", "cells", "α")
    print_table(columns, rows, title=f"{title}{result['period_texel']:g}; {_base_text(result['base'])}")
    for told in result["simpler"]:
        note(f"{told[:1].upper()}{told[1:]}.")
    if "plain" in result:
        share = result["factor"]
        note(f"Both: {1.0 - share:g} of the surface without layers, plain, and {share:g} of the layers.")


def _base_text(base: Mapping[str, Any]) -> str:
    def colour(values: Any) -> str:
        return ", ".join(f"{v:.4g}" for v in values)

    parts = []
    if base["diffuse"].any():
        parts.append(f"diffuse {colour(base['diffuse'])}")
    if base["metal_share"]:
        share = f"{base['metal_share']:g} of a metal of F0 {colour(base['metal_f0'])}"
        parts.append(f"{share}, α {base['metal_alpha']:.4g}")
    if base["transmission"].any():
        parts.append(f"what comes from behind times {colour(base['transmission'])}")
    return f"below them {'; '.join(parts) or 'nothing that sends light back'}"


def chosen_material(
    materials: tuple[Material, ...], name: str | None, file: Path, *, has_layers: bool = False
) -> int:
    """Return the index of the material called `name` or numbered so, or of the only one with a film.

    has_layers : one with Bragg layers is as good.
    Raises UsageError where there is none, or more than one, and lists them.
    """
    from gltf_iri.errors import UsageError

    candidates = list(range(len(materials)))
    if name is None:
        candidates = fits = [
            i
            for i, each in enumerate(materials)
            if each.iridescence is not None or (has_layers and each.bragg is not None)
        ]
    else:
        fits = [i for i, material in enumerate(materials) if material.name == name]
        if not fits and name.isdecimal() and int(name) < len(materials):
            fits = [int(name)]
    if len(fits) == 1:
        return fits[0]
    kind = "with a film or layers" if has_layers else "with a film"
    wanted = kind if name is None else f"called '{name}'"
    has = f"{len(fits)} materials {wanted}" if fits else f"no material {wanted}"
    if not candidates:
        raise UsageError(f"{file} has {has}; name another file.")
    listed = ", ".join(material_label(i, materials[i].name) for i in candidates[:_LISTED_MAX])
    more = f" and {len(candidates) - _LISTED_MAX} more" if len(candidates) > _LISTED_MAX else ""
    raise UsageError(f"{file} has {has}; choose one with --material from: {listed}{more}.")
