"""Image light: from a file, or made here."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.asset.guard import read_given
from gltf_iri.asset.limits import MAX_IMAGE_FILE_BYTES
from gltf_iri.errors import AssetError, UsageError, naming_file
from gltf_iri.scene.exr import read_exr
from gltf_iri.scene.model import Environment
from gltf_iri.scene.radiance_hdr import read_radiance
from gltf_iri.scene.studio import studio_radiance

__all__ = ["RADIANCE_MAX", "read_environment", "studio", "white"]

# Behind a model in the studio: a dark grey card. A film that passes on nine tenths of the light shows its
# colours against the dark only, and black things still stand out from it.
_STUDIO_BACKDROP = (0.06, 0.06, 0.06)

# The largest half float.
_HALF_MAX: Final = np.float32(65504.0)

# Sums over all texels of a map, times the densest lobe, stay within float32.
# The sun's disc has some 1e9 cd/m².
RADIANCE_MAX: Final = np.float32(1e24)

Float32 = NDArray[np.float32]

_OPENEXR_MAGIC = b"\x76\x2f\x31\x01"


def read_environment(path: str | PathLike[str]) -> Environment:
    """Return the equirectangular map of a Radiance (.hdr) or OpenEXR (.exr) file, told apart by their bytes.

    Its width must be twice its height. What cannot be light is changed and noted: negative values, which
    lossy compression leaves around bright lights, become 0; +∞, which 16-bit files hold where a light was
    brighter than their largest number, becomes that number; and nothing stays above RADIANCE_MAX. Raises
    UsageError where the file cannot be read, AssetError where it is no such map or holds what is no number.
    """
    place = Path(path)
    data = read_given(place, MAX_IMAGE_FILE_BYTES)
    if data.startswith(_OPENEXR_MAGIC):
        radiance = read_exr(place)
    elif data.startswith(b"#?"):
        with naming_file(place):
            radiance = read_radiance(data)
    else:
        raise UsageError(f"{place} is neither a Radiance (.hdr) nor an OpenEXR (.exr) picture.")
    return _checked(place, radiance)


def white() -> Environment:
    """Return radiance 1 from everywhere: the furnace, in which a perfect mirror cannot be seen."""
    return Environment("white", np.ones((2, 4, 3), dtype=np.float32))


def studio() -> Environment:
    """Return a photographer's studio: key, fill, rim and overhead soft boxes, 256 × 512, mean radiance 1."""
    return Environment("studio", studio_radiance(), backdrop=_STUDIO_BACKDROP)


def _checked(place: Path, radiance: Float32) -> Environment:
    height, width, _ = radiance.shape
    if width != 2 * height:
        raise AssetError(
            f"an equirectangular map is twice as wide as high, and this picture is {width} × {height}",
            file=place,
        )
    broken = np.isnan(radiance) | np.isneginf(radiance)
    if broken.any():
        row, column, _ = (int(n) for n in np.argwhere(broken)[0])
        raise AssetError(
            f"{_count(broken)} pixels are not numbers, the first in row {row}, column {column}", file=place
        )
    negative, infinite = radiance < 0.0, np.isposinf(radiance)
    blinding = (radiance > RADIANCE_MAX) & ~infinite
    lowest = f" (down to {float(radiance.min()):.3g})"
    notes = []
    for wrong, replacement, what in (
        (negative, np.float32(0.0), f"with negative light{lowest}"),
        (infinite, _HALF_MAX, "of infinite light"),
        (blinding, RADIANCE_MAX, "beyond what single precision can sum"),
    ):
        if wrong.any():
            notes.append(f"{place.name} has {_count(wrong)} pixels {what}: set to {replacement:.6g}.")
            radiance = np.where(wrong, replacement, radiance)
    return Environment(place.name, radiance, tuple(notes))


def _count(channels: NDArray[np.bool_]) -> int:
    """Return in how many pixels of (height, width, 3) a channel is True."""
    return int(channels.any(axis=2).sum())
