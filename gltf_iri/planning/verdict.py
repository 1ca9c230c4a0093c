"""The verdict on one effect: simulate it, leave it out with a reason, or admit that it is missing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from gltf_iri.material.texture import TextureInfo

__all__ = ["UV_SETS_READ", "NotDrawn", "Skip", "Verdict", "absent", "texture_verdict"]

# Vertices bring TEXCOORD_0 and TEXCOORD_1 to the shader, which glTF 2.0 §3.7.2.1 asks of every client.
UV_SETS_READ: Final = 2


@dataclass(frozen=True, slots=True)
class Skip:
    """The material does not call for the effect; `is_absent` where the file does not even mention it."""

    reason: str
    is_absent: bool = False


@dataclass(frozen=True, slots=True)
class NotDrawn:
    """The material calls for the effect and this program does not simulate it."""

    reason: str


Verdict = Skip | NotDrawn | None  # None: the effect is simulated


def absent(what: str) -> Skip:
    """Return the verdict on something that the file does not mention."""
    return Skip(f"no {what}", is_absent=True)


def texture_verdict(info: TextureInfo | None, what: str, idle: str | None, folded: str | None) -> Verdict:
    """Judge a texture.

    idle : why it would change nothing, None where it would change something.
    folded : why the factor holds all that the texture says, None where it is a texture still.
    """
    if info is None:
        return absent(what) if folded is None else Skip(folded)
    if idle is not None:
        return Skip(idle)
    if info.uv_set >= UV_SETS_READ:
        return NotDrawn(f"it is read with UV set {info.uv_set}, and only sets 0 and 1 reach the shader")
    return None
