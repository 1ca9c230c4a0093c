"""Method `khr`: the iridescence Fresnel of KHR_materials_iridescence, to the letter.

Lines follow the order of the extension's Implementation Notes. Where the text leaves a value undefined, IEEE
arithmetic decides (a division by zero gives NaN) and `Evaluation.undefined` says which rows it was. The one
departure is x·x for pow(x, 2.0), which GLSL leaves undefined for x < 0: no value that is defined changes.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.backends import Backend
from gltf_iri.colour.sensitivity import eval_sensitivity
from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.film import Evaluation, Film
from gltf_iri.optics.fresnel import f_schlick
from gltf_iri.optics.ior import fresnel0_to_ior, ior_to_fresnel0
from gltf_iri.optics.refraction import cos_theta_2_squared

__all__ = ["evaluate_khr", "iridescent_fresnel_khr", "khr_branch_distance_ulp"]

Float64 = NDArray[np.float64]
Sensitivity = Callable[[Float64, Float64], Float64]

F0_OFFSET = 0.0001  # the text's "guard against 1.0", which moves the pole from 1 to 0.9999
R123_RANGE = (1e-5, 0.9999)
ORDERS = (1, 2)


def iridescent_fresnel_khr(
    outside_ior: ArrayLike,
    film_ior: ArrayLike,
    base_f0: ArrayLike,
    thickness_nm: ArrayLike,
    cos_theta_1: ArrayLike,
    *,
    sensitivity: Sensitivity = eval_sensitivity,
) -> Float64:
    """Return the text's iridescent_fresnel(...), linear Rec.709 (..., 3), clamped below at 0 and not above.

    outside_ior, film_ior, thickness_nm, cos_theta_1 : (...), broadcast together.
    base_f0 : (..., 3).
    sensitivity : what stands for the text's evalSensitivity; the benchmark puts exact integrals here.
    """
    n1, n2, d_nm, c1 = (
        np.asarray(a, dtype=np.float64)[..., None] for a in (outside_ior, film_ior, thickness_nm, cos_theta_1)
    )
    base_f0 = np.asarray(base_f0, dtype=np.float64)

    cos2_sq = cos_theta_2_squared(n1, n2, c1)
    # Under total internal reflection the text returns before the root; 0 keeps it real until then.
    c2 = np.sqrt(np.maximum(cos2_sq, 0.0))

    # First interface
    R12 = f_schlick(ior_to_fresnel0(n2, n1), c1)
    T121 = 1.0 - R12

    # Second interface
    base_ior = fresnel0_to_ior(base_f0 + F0_OFFSET)
    R23 = f_schlick(ior_to_fresnel0(base_ior, n2), c2)

    # Phase shift
    opd_nm = 2.0 * n2 * d_nm * c2
    phi12 = np.where(n2 < n1, np.pi, 0.0)
    phi23 = np.where(base_ior < n2, np.pi, 0.0)
    phi = (np.pi - phi12) + phi23

    # Compound terms
    R123 = np.clip(R12 * R23, *R123_RANGE)
    r123 = np.sqrt(R123)
    Rs = T121 * T121 * R23 / (1.0 - R123)

    colour = R12 + Rs
    Cm = Rs - T121
    for m in ORDERS:
        Cm = Cm * r123
        colour = colour + Cm * 2.0 * sensitivity(m * opd_nm[..., 0], m * phi)

    return np.asarray(np.where(cos2_sq < 0.0, 1.0, np.maximum(colour, 0.0)))


def evaluate_khr(film: Film, white: White, *, backend: Backend = "numpy") -> Evaluation:
    """Evaluate `khr`; the text knows no illuminant, so the same numbers stand under either white."""
    arguments = (film.outside_ior, film.film_ior, film.base.f0, film.thickness_nm, film.cos_theta_1)
    if backend == "numba":
        rgb = _compiled(arguments, film.shape)
    else:
        rgb = np.broadcast_to(iridescent_fresnel_khr(*arguments), (*film.shape, 3))
    return Evaluation(rgb, "khr", str(white), undefined=_undefined(film))


def _compiled(arguments: tuple[Float64, ...], shape: tuple[int, ...]) -> Float64:
    from gltf_iri.compiled import khr

    shapes = [shape, shape, (*shape, 3), shape, shape]
    n1, n2, base_f0, d_nm, c1 = (
        np.ascontiguousarray(np.broadcast_to(a, s)).reshape(-1)
        for a, s in zip(arguments, shapes, strict=True)
    )
    rgb = np.zeros((*shape, 3))
    khr.iridescent_fresnel_khr(n1, n2, base_f0, d_nm, c1, rgb.reshape(-1))
    return rgb


def khr_branch_distance_ulp(film: Film) -> Float64:
    """Return (...): float32 ulp between the film and the nearest of the text's branches.

    Branches: film = outside index, film = base index (each channel), the critical angle. A row closer than
    some ulp may fall on either side in float32, and both answers follow the text.
    """
    base_ior = fresnel0_to_ior(film.base.f0 + F0_OFFSET)
    n2 = film.film_ior[..., None]
    pairs = [
        (film.film_ior, film.outside_ior),
        *((base_ior[..., channel], n2[..., 0]) for channel in range(3)),
        (cos_theta_2_squared(film.outside_ior, film.film_ior, film.cos_theta_1) + 1.0, np.ones(())),
    ]
    distances = [
        np.abs(a - b) / np.spacing(np.abs(b).astype(np.float32)).astype(np.float64) for a, b in pairs
    ]
    nearest = np.full(film.shape, np.inf)
    for distance in distances:
        nearest = np.fmin(nearest, distance)
    return nearest


def _undefined(film: Film) -> dict[str, NDArray[np.bool_]]:
    # float32 rounds 0.9999 down and the sum up to 1: one float32 step below belongs to the pole too.
    at_pole = film.base.f0 >= 0.9999 - 2.0**-23
    base_ior = fresnel0_to_ior(film.base.f0 + F0_OFFSET)
    negative = (base_ior < film.film_ior[..., None]).any(axis=-1) | (film.film_ior < film.outside_ior)
    cases = {
        "Fresnel0ToIor divides by zero or turns negative (F0 ≥ 0.9999)": at_pole.any(axis=-1),
        "pow(x, 2.0) of a negative x (x·x used)": negative,
    }
    masks = {name: np.broadcast_to(mask, film.shape) for name, mask in cases.items()}
    return {name: mask for name, mask in masks.items() if mask.any()}
