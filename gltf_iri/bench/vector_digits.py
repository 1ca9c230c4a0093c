"""Every row of the test vectors against 50 digits: `python -m gltf_iri.bench.vector_digits spec/vectors`.

Minutes. Reflectances of all facets and films, by the matrices of `fifty_digits`, which share no formula with
what wrote the vectors.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from gltf_iri.asset.strict_json import parse_json
from gltf_iri.bench.fifty_digits import mirror_50_digits, stack_50_digits
from gltf_iri.conformance.bragg_input import read_bragg_input
from gltf_iri.conformance.khr_rows import khr_film
from gltf_iri.errors import GltfIriError
from gltf_iri.optics.layer_stack import sight_of

__all__ = ["bragg_errors", "film_errors", "main"]

Row = Mapping[str, Any]


def bragg_errors(row: Row, wavelengths_nm: Sequence[float]) -> Iterator[float]:
    """Yield how far each reflectance of a row of EXT_materials_bragg is from that of 50 digits."""
    read = read_bragg_input(row["input"])
    cosine = float(sight_of(read.host_ior, read.cos_theta_i, read.cos_theta_o, read.cos_phi).cos_h)
    for facets, given in zip(read.facets, row["output"]["reflectance"], strict=True):
        films = facets.n1, facets.n2, facets.d1_nm, facets.d2_nm, facets.cells
        for nm, value in zip(wavelengths_nm, given, strict=True):
            exact = mirror_50_digits(facets.host_ior, *films, nm, min(cosine, 1.0))
            yield abs(float(exact.reflected - value))


def film_errors(row: Row, wavelengths_nm: Sequence[float]) -> Iterator[float]:
    """Yield the same of a row of KHR_materials_iridescence; an infinite index must reflect all."""
    film = khr_film(row["input"])
    n1, n2, d_nm, c = (
        float(x) for x in (film.outside_ior, film.film_ior, film.thickness_nm, film.cos_theta_1)
    )
    for nm, given in zip(wavelengths_nm, row["output"]["reflectance"], strict=True):
        for index, value in zip(film.base.index.real.reshape(3), given, strict=True):
            is_mirror = index == float("inf")
            exact = 1.0 if is_mirror else stack_50_digits([n1, n2, float(index)], [d_nm], nm, c).reflected
            yield abs(float(exact - value))


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the greatest error of each file in the folder that is named; return the exit code."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    folder = Path(given[0] if given else "spec/vectors")
    for name, errors in (
        ("ext_materials_bragg.json", bragg_errors),
        ("khr_materials_iridescence.json", film_errors),
    ):
        try:
            vectors = parse_json((folder / name).read_bytes())
        except (OSError, GltfIriError) as error:
            sys.stderr.write(f"{folder / name} is not readable: {error}\n")
            return 2
        found = [max(errors(row, vectors["wavelengths_nm"]), default=0.0) for row in vectors["rows"]]
        worst = max(range(len(found)), key=found.__getitem__)
        sys.stdout.write(f"{name}: {len(found)} rows, at most {found[worst]:.2g} off, in row {worst}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
