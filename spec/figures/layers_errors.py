"""What multiplying colours, or means over bands, errs by through layers: the tables of layers-notes.md.

`python spec/figures/layers_errors.py [STACKS]` prints them; 600 stacks take minutes. Every spectrum is taken
once, at 1025 wavelengths, and multiplied as a spectrum, as colours and as means.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.bench.layer_set import layer_set, named_stacks
from gltf_iri.colour.bands import bands_of
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.colour.quadrature import colour_rule
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.layers import LayerStack, Pose
from gltf_iri.optics.bragg import bragg_reflectance
from gltf_iri.optics.layer_stack import Sight, sight_of
from gltf_iri.optics.rough_bragg import filter_nodes

Float64 = NDArray[np.float64]

RULE: Final = colour_rule(1024, "D65")
POINTS: Final = 32
BANDS: Final = (4, 6, 8, 12, 16, 24, 32, 64)
REFLECTANCES: Final = ("yeh-spectral", "bloch", "landmarks", "landmarks-sub")
PLACES: Final = {1: "second layer", 2: "third layer"}


def factors(stack: LayerStack, sight: Sight, row: int) -> tuple[list[Float64], list[Float64]]:
    """Return each layer's R(h) (k,), and its T(i) and T(o) (2, k)."""
    reflected, passed = [], []
    cosines = np.array(
        [float(np.ravel(c)[row % np.size(c)]) for c in (sight.cos_h, sight.cos_i, sight.cos_o)]
    )
    host = float(np.ravel(stack.host_ior)[row % np.size(stack.host_ior)])
    for layer in stack.layers:
        fields = (layer.n1, layer.n2, layer.d1_nm, layer.d2_nm, layer.cells, layer.alpha)
        n1, n2, d1_nm, d2_nm, cells, alpha = (np.ravel(a)[row % np.size(a)] for a in fields)
        nodes, weights = filter_nodes(cosines[1:], alpha, count=POINTS)
        at = np.append(nodes.reshape(-1), cosines[0])
        spectra = bragg_reflectance(host, n1, n2, d1_nm, d2_nm, cells, RULE.wavelength_nm, at[:, None])
        reflected.append(spectra[-1])
        passed.append(np.einsum("dn,dnk->dk", weights, 1.0 - spectra[:-1].reshape(2, -1, spectra.shape[-1])))
    return reflected, passed


def paths(reflected: list[Float64], passed: list[Float64]) -> dict[str, Float64]:
    """Return each path's factors (f, k): of every layer but the first, and of bases below so many."""
    found = {}
    for number in range(1, len(passed) + 1):
        above = np.concatenate(passed[:number])
        found[f"base below {number}"] = above
        if number < len(passed):
            found[PLACES[number]] = np.concatenate([reflected[number][None], above])
    return found


def errors(stack: LayerStack, pose: Pose) -> dict[str, dict[str, Float64]]:
    """Return method → path → ΔE (n,)."""
    sight = sight_of(stack.host_ior, pose.cos_theta_i, pose.cos_theta_o, pose.cos_phi)
    count = np.size(pose.cos_theta_i)
    sums = {"truth": (RULE.weights, np.eye(3)), "layers-rgb, exact colours": (RULE.weights, np.eye(3))}
    for b in BANDS:
        bands = bands_of(b, "D65")
        sums[f"layers-bands, bands {b}"] = (bands.shares(RULE), bands.weights)
    rgb: dict[str, dict[str, list[Float64]]] = {name: {} for name in sums}
    for row in range(count):
        for path, spectra in paths(*factors(stack, sight, row)).items():
            for name, (shares, weights) in sums.items():
                product = (
                    np.prod(spectra, axis=0) @ RULE.weights
                    if name == "truth"
                    else np.prod(spectra @ shares, axis=0) @ weights
                )
                rgb[name].setdefault(path, []).append(product)
    colours = {name: {path: np.array(rows) for path, rows in of.items()} for name, of in rgb.items()}
    for reflectance in REFLECTANCES[1:]:
        method = layer_colours("layers-rgb", stack, parameters={"reflectance": reflectance})
        of_path = {}
        for number in range(1, len(stack.layers) + 1):
            upper = LayerStack.of(stack.layers[:number], stack.host_ior) if number else stack
            below = layer_colours("layers-rgb", upper, parameters={"reflectance": reflectance})
            of_path[f"base below {number}"] = below.passed(sight.cos_i, sight.cos_o)
            if number < len(stack.layers):
                of_path[PLACES[number]] = method.reflected(number, sight.cos_h, sight.cos_i, sight.cos_o)
        colours[f"layers-rgb, reflectance {reflectance}"] = of_path
    truth = colours.pop("truth")
    return {
        name: {path: delta_e_2000(each, truth[path]) for path, each in of.items()}
        for name, of in colours.items()
    }


def table(found: Mapping[str, Mapping[str, Float64]]) -> str:
    """Return mean, p95 and max of each, in Markdown."""
    names = list(next(iter(found.values())))
    lines = [f"| method | {' | '.join(names)} |", "|---|" + "---|" * len(names)]
    for method, of in found.items():
        cells = (f"{e.mean():.2f} / {np.percentile(e, 95):.2f} / {e.max():.1f}" for e in of.values())
        lines.append(f"| {method} | {' | '.join(cells)} |")
    return "\n".join(lines)


def main() -> None:
    """Print the tables."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 600
    sys.stdout.write(table(errors(*layer_set(count, 3))) + "\n")
    g = np.random.default_rng(1)
    poses = max(count // 3, 2)
    pose = Pose.of(g.random(poses), g.random(poses), np.cos(g.uniform(0.0, 2.0 * np.pi, poses)))
    for name, stack in named_stacks().items():
        sys.stdout.write(f"\n{name}\n\n{table(errors(stack, pose))}\n")


if __name__ == "__main__":
    main()
