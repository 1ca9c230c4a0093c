"""`gltf-iri evaluate --layer …`: what layered mirrors send back, let through and keep, or their BRDF."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import click

from gltf_iri.cli.common import note, print_table
from gltf_iri.cli.evaluate_subject import How, note_undefined, title_of, undefined_at
from gltf_iri.planning.method import DEFAULT_LAYERS_METHOD

if TYPE_CHECKING:
    from gltf_iri.evaluation.layers import LayerStack
    from gltf_iri.evaluation.stack_evaluation import StackEvaluation

__all__ = ["evaluated", "from_layers", "layer_options", "print_layers", "refuse_layer_options", "stack_json"]

_OF_LAYERS = ("layer", "host_ior", "base_diffuse", "base_metal", "base_alpha", "light")
_OF_THE_BASE = ("base_diffuse", "base_metal", "base_alpha")


def layer_options(command: Any) -> Any:
    """Add the options that describe a stack and its light; `refuse_layer_options` where no layer is."""
    from gltf_iri.cli.value_types import Numbers

    for decorate in (
        click.option(
            "--period-texel",
            type=float,
            metavar="G",
            help="Of FILE's layers: value of the texture that their periods run along [1].",
        ),
        click.option(
            "--light",
            type=Numbers(1, 2),
            metavar="COS[,COS_PHI]",
            help="Light layers from one direction, and print their BRDF as it is seen at each --cos; "
            "COS_PHI −1 is the mirror side [-1].",
        ),
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
    from gltf_iri.evaluation.stack_evaluation import stack_of

    for option, value in given.items():
        if value is not None and option not in _OF_LAYERS:
            raise click.UsageError(f"layers have no --{option.replace('_', '-')}; leave it out")
    stack = stack_of(
        given["layer"],
        given["host_ior"],
        _one_or_three(given["base_diffuse"]),
        given["base_metal"],
        given["base_alpha"],
    )
    return stack_json(cosines, given["light"], evaluated(stack, cosines, how, given["light"]))


def evaluated(
    stack: LayerStack, cosines: tuple[float, ...], how: How, light: tuple[float, ...] | None
) -> StackEvaluation:
    """Return `stack` by the method or within the budget that was asked for."""
    if how.budget is not None:
        from gltf_iri.budgets.stacks import evaluate_stack_within

        return evaluate_stack_within(stack, cosines, how.budget, light, white=how.white, backend=how.backend)
    from gltf_iri.evaluation.stack_evaluation import evaluate_stack

    return evaluate_stack(
        how.method or DEFAULT_LAYERS_METHOD,
        stack,
        cosines,
        light,
        white=how.white,
        backend=how.backend,
        parameters=how.parameters,
    )


def stack_json(
    cosines: tuple[float, ...], light: tuple[float, ...] | None, done: StackEvaluation
) -> dict[str, Any]:
    """Return what `evaluate --json` prints of a stack, whoever described it.

    Lit from one direction its colour is a BRDF, under a name of its own: "rgb" is always a reflectance.
    """
    chosen = {}
    if done.delta_e is not None:
        chosen = {"delta_e": done.delta_e, "ns_per_colour": done.ns_per_colour}
    if light is None:
        colours: dict[str, Any] = {
            "rgb": done.rgb,
            "transmitted": done.transmitted,
            "absorbed": done.absorbed,
            "from_base": done.from_base,
        }
    else:
        turn = light[1] if len(light) == 2 else -1.0
        colours = {"light": {"cos": light[0], "cos_phi": turn}, "brdf": done.rgb}
    return {
        "method": done.method,
        "white": done.white,
        "cos": cosines,
        **colours,
        "mirrored": done.mirrored,
        "backend": done.backend,
        "parameters": dict(done.parameters),
        **chosen,
        "undefined": undefined_at(cosines, done),
    }


def refuse_layer_options(given: dict[str, Any], *, has_file: bool) -> None:
    """Raise where an option of a stack stands without a --layer, or one for a FILE's without a FILE."""
    for name in _OF_THE_BASE:
        if given[name] is not None:
            raise click.UsageError(f"--{name.replace('_', '-')} lies under layers: give --layer too")
    if not has_file and given["light"] is not None:
        raise click.UsageError("--light asks for the BRDF of layers: give --layer or a FILE that has some")
    if not has_file and given["period_texel"] is not None:
        raise click.UsageError("--period-texel is a value of a FILE's texture: give a FILE")


def print_layers(result: Mapping[str, Any], *, more: str = "") -> None:
    """Print a stack's result for people: a row for each angle; `more` ends the title."""
    groups: list[tuple[str, Sequence[Sequence[float]]]]
    if "brdf" in result:
        groups = [("", result["brdf"])]
    elif "plain" in result:
        groups = [("", result["rgb"])]
    else:
        groups = [(name, result[key]) for name, key in _SHARES]
    if "plain" in result:
        groups += [("plain ", result["plain"]), ("both ", result["layered"])]
    columns = ["cos θ", *(name for title, _ in groups for name in (f"{title}R", "G", "B"))]
    rows = [
        [f"{c:g}", *(f"{v:.6f}" for each in colours for v in each)]
        for c, *colours in zip(result["cos"], *(values for _, values in groups), strict=True)
    ]
    print_table(columns, rows, title=f"{title_of(result)}{more}")
    if "brdf" in result:
        light = result["light"]
        note(f"These are f_r in 1/sr, lit at cos θ = {light['cos']:g} and cos φ = {light['cos_phi']:g}.")
        if result["mirrored"].any():
            shares = ", ".join(f"{share:.6f}" for share in result["mirrored"])
            note(f"Beside them the host's smooth surface mirrors its own share of light: {shares}.")
    elif "plain" not in result:
        note("What is transmitted comes from the truth, whatever the method, and reaches the base.")
    note("Light that is reflected more than once is not sent back; it counts as absorbed.")
    note_undefined(result)


_SHARES = (("", "rgb"), ("transmitted ", "transmitted"), ("absorbed ", "absorbed"))


def _one_or_three(values: tuple[float, ...] | None) -> float | tuple[float, ...] | None:
    return values[0] if values is not None and len(values) == 1 else values
