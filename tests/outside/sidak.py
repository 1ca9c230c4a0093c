"""Whether two pictures agree within their errors, over all samples at once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import mpmath
import numpy as np
from numpy.typing import NDArray

__all__ = ["FAMILY_RISK", "Verdict", "compare_means"]

Float64 = NDArray[np.float64]

FAMILY_RISK: Final = 0.01


@dataclass(frozen=True, slots=True)
class Verdict:
    """What the samples say together."""

    count: int
    least_p: float  # the most surprising sample's chance, if both sides had the same mean
    risk_each: float  # α₁ = 1 − (1 − α)^(1/n), Šidák 1967, n of all scenes
    rms_z: float  # 1 where the errors are as large as they are said to be
    largest_z: float

    @property
    def agrees(self) -> bool:
        """True where no sample is more surprising than one in a family may be."""
        return self.least_p >= self.risk_each

    def __str__(self) -> str:
        return (
            f"{self.count} samples, |z| rms {self.rms_z:.2f}, max {self.largest_z:.2f}, "
            f"least p {self.least_p:.1e} against {self.risk_each:.1e}"
        )


def compare_means(
    batches: Float64, expected: Float64, expected_error: Float64, expected_freedom: int, *, scenes: int = 1
) -> Verdict:
    """Compare the means of independent `batches` (b, ...) with `expected` (...) and its standard error (...).

    Two-sided, each sample by Student's distribution with the degrees of freedom of Satterthwaite 1946 and
    Welch 1947: (a² + b²)² / (a⁴/ν_a + b⁴/ν_b). `scenes` of them, judged alike, are one family.
    """
    count = len(batches)
    variance, expected_variance = batches.var(axis=0, ddof=1) / count, expected_error**2
    total = variance + expected_variance
    z = np.abs(batches.mean(axis=0) - expected) / np.sqrt(total)
    freedom = total**2 / (variance**2 / (count - 1) + expected_variance**2 / expected_freedom)
    chances = [_two_sided(*pair) for pair in zip(z.ravel(), freedom.ravel(), strict=True)]
    return Verdict(
        count=z.size,
        least_p=min(chances),
        risk_each=1.0 - (1.0 - FAMILY_RISK) ** (1.0 / (scenes * z.size)),
        rms_z=float(np.sqrt(np.mean(z**2))),
        largest_z=float(z.max()),
    )


def _two_sided(z: float, freedom: float) -> float:
    """Return the chance that Student's t lies beyond ±z: I_x(ν/2, ½), x = ν / (ν + z²) (NIST DLMF 8.17)."""
    return float(mpmath.betainc(0.5 * freedom, 0.5, 0.0, freedom / (freedom + z * z), regularized=True))
