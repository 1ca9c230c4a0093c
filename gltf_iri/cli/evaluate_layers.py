"""`gltf-iri evaluate --layer …`: what layered mirrors send back, let through and keep, over angles."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import click

from gltf_iri.backends import choose_backend
from gltf_iri.cli.budget import nanoseconds
from gltf_iri.cli.common import note, print_table
from gltf_iri.planning.method import DEFAULT_LAYERS_METHOD, find_method, parameters_text

if TYPE_CHECKING:
    from gltf_iri.cli.evaluate_subject import How

__all__ = ["from_layers", "layer_options", "print_layers", "refuse_layer_options"]

_OF_LAYERS = ("layer", "host_ior", "base_diffuse", "base_metal", "base_alpha")
_ONLY_OF_LAYERS = tuple(name for name in _OF_LAYERS if name != "host_ior")


def layer_options(command: Any) -> Any:
    """Add the options that describe a stack; `refuse_layer_options` where no layer is."""
    from gltf_iri.cli.value_types import Numbers

    for decorate in (
        click.option(
            "--base-alpha", type=float, metavar="A", help="Roughness α of --base-metal, in (0, 1] [0.1]."
        ),
        click.option("--base-metal", type=Numbers(3), metavar="R,G,B", help="Metal under --layer."),
        click.option(
            "--base-diffuse", type=Numbers(1, 3), metavar="R|R,G,B", help="Lambertian base under --layer [0]."
        ),
        click.option(
            "--layer",
            type=Numbers(6),
            multiple=True,
            metavar="N1,N2,D1,D2,CELLS,ALPHA",
            help="Rough mirror among layers, outermost first; once for each.",
        ),
    ):
        command = decorate(command)
    return command


def from_layers(cosines: tuple[float, ...], how: How, given: dict[str, Any]) -> dict[str, Any]:
    """Return what `evaluate --json` prints of the layers `given`; a film's options are refused."""
    from gltf_iri.colour.spaces import WHITES
    from gltf_iri.evaluation.layer_energy import stack_energy
    from gltf_iri.evaluation.layer_methods import layer_colours
    from gltf_iri.evaluation.layers import BraggLayer, LayerBase, LayerStack, Pose
    from gltf_iri.evaluation.parameters import checked_parameters

    for option, value in given.items():
        if value is not None and option not in _OF_LAYERS:
            raise click.UsageError(f"layers have no --{option.replace('_', '-')}; leave it out")
    if given["base_alpha"] is not None and given["base_metal"] is None:
        raise click.UsageError("--base-alpha is the roughness of --base-metal; give both")
    layers = tuple(BraggLayer.of(*values) for values in given["layer"])
    metal = given["base_metal"]
    if metal is not None:
        _refuse_more_than_all(given["base_diffuse"], metal)
    base = LayerBase.of(
        _or(given["base_diffuse"], 0.0),
        _or(metal, 0.0),
        0.0 if metal is None else 1.0,
        _or(given["base_alpha"], 0.1),
    )
    host = given["host_ior"]
    # Layers lie in their host: where nobody names it, it is what the first of them says.
    stack = LayerStack.of(layers, float(layers[0].n1) if host is None else host, base)
    name, kept = how.method or DEFAULT_LAYERS_METHOD, {}
    chosen: Mapping[str, Any] = how.parameters
    if how.budget is not None:
        from gltf_iri.budgets.stacks import way_for_stack

        way = way_for_stack(stack, how.budget, white=how.white).way
        name, chosen = str(way.method), way.parameters
        kept = {"delta_e": way.delta_e, "ns_per_colour": way.ns_per_colour}
    method = find_method(name, "layers")
    backend = choose_backend(how.backend, len(cosines), method.backends, method.name)
    colours = layer_colours(method.name, stack, white=how.white, parameters=chosen)
    white = next(name for name in WHITES if name == how.white)  # `layer_colours` knows it
    energy = stack_energy(stack, Pose.of(cosines, 1.0).cos_theta_i, colours, white)
    return {
        "method": method.name,
        "white": how.white,
        "cos": cosines,
        "rgb": energy.reflected,
        "transmitted": energy.transmitted,
        "absorbed": energy.absorbed,
        "from_base": energy.from_base,
        "backend": backend,
        "parameters": checked_parameters(method, chosen),
        **kept,
        "undefined": {},
    }


def _refuse_more_than_all(diffuse: tuple[float, ...] | None, metal: tuple[float, ...]) -> None:
    """Raise where diffuse base and metal, which lie side by side, send back more than they receive."""
    shares = (0.0,) if diffuse is None else diffuse
    if max(d + f0 for d, f0 in zip(shares * (3 // len(shares)), metal, strict=True)) > 1.0:
        raise click.UsageError(
            "--base-diffuse and --base-metal lie side by side: no channel may add up to more than 1"
        )


def refuse_layer_options(given: dict[str, Any]) -> None:
    """Raise where an option of a stack stands without a --layer."""
    for name in _ONLY_OF_LAYERS:
        if given[name] is not None:
            raise click.UsageError(f"--{name.replace('_', '-')} lies under layers: give --layer too")


def print_layers(result: dict[str, Any]) -> None:
    """Print `from_layers`' result for people: a row for each angle."""
    columns = ["cos θ", "R", "G", "B", "transmitted R", "G", "B", "absorbed R", "G", "B"]
    rows = [
        [f"{c:g}", *(f"{v:.6f}" for each in colours for v in each)]
        for c, *colours in zip(
            result["cos"], result["rgb"], result["transmitted"], result["absorbed"], strict=True
        )
    ]
    method = ", ".join(filter(None, (result["method"], parameters_text(result["parameters"]))))
    kept = ""
    if "delta_e" in result:
        from gltf_iri.budgets.search import figure

        kept = f", ΔE ≤ {figure(result['delta_e'])} for {nanoseconds(result['ns_per_colour'])} a colour"
    title = f"{method}{kept}, by {result['backend']}, {result['white']} white, linear Rec.709"
    print_table(columns, rows, title=title)
    note("Light that is reflected more than once is not sent back; it counts as absorbed.")
    note("What is transmitted comes from the truth, whatever the method, and reaches the base.")


def _or(value: Any, default: float) -> Any:
    return default if value is None else value
