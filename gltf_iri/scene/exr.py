"""OpenEXR pictures as image light, read with the OpenEXR package."""

from __future__ import annotations

import contextlib
import io
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.asset.limits import MAX_IMAGE_PIXELS
from gltf_iri.errors import AssetError

if TYPE_CHECKING:
    import OpenEXR

__all__ = ["read_exr"]

Float32 = NDArray[np.float32]

# CIE xy of red, green, blue and white in ITU-R BT.709-6, table 1.
_REC709: Final = (0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290)


def read_exr(path: Path) -> Float32:
    """Return the first part's picture (height, width, 3), linear Rec.709, row 0 at the top.

    A picture of luminance alone becomes grey. Raises AssetError where it cannot be read, is cropped, or is
    made of other primaries.
    """
    header = _open(path, header_only=True).header()
    low, high = header["dataWindow"]
    if not np.array_equal((low, high), header["displayWindow"]):
        raise AssetError("the picture is cropped (data window and display window differ)", file=path)
    width, height = (int(n) for n in high.astype(np.int64) - low + 1)
    if not 0 < width * height <= MAX_IMAGE_PIXELS:
        raise AssetError(
            f"the picture has {width} × {height} pixels; 1 to {MAX_IMAGE_PIXELS} are read", file=path
        )
    primaries = header.get("chromaticities")
    if primaries is not None and not np.allclose(np.ravel(primaries), _REC709, atol=2e-3):
        raise AssetError("the picture's primaries are not Rec.709's; convert it to linear Rec.709", file=path)

    channels = _open(path, header_only=False).channels()
    for names in (("R", "G", "B"), ("Y", "Y", "Y")):
        if set(names) <= set(channels):
            planes = [np.asarray(channels[name].pixels) for name in names]
            if any(plane.shape != (height, width) for plane in planes):
                raise AssetError("the picture's channels differ in size", file=path)
            return np.stack(planes, axis=2).astype(np.float32)
    found = ", ".join(sorted(channels)) or "none that can be decoded"
    raise AssetError(f"the picture needs the channels R, G and B, or Y; it has {found}", file=path)


def _open(path: Path, *, header_only: bool) -> OpenEXR.File:
    import OpenEXR

    # The package prints what it could not decode instead of raising; a printed line would end up in --json.
    with contextlib.redirect_stdout(io.StringIO()):
        try:
            picture: Any = OpenEXR.File(str(path), separate_channels=True, header_only=header_only)
        except (OSError, RuntimeError, TypeError, ValueError) as error:
            raise AssetError("the file is not an OpenEXR picture that can be read", file=path) from error
    if not picture.parts:
        raise AssetError("the OpenEXR picture is damaged or cut short", file=path)
    return picture
