"""How large a stack of Bragg layers may be: for every reader, and for this one."""

from __future__ import annotations

__all__ = [
    "BRAGG_CELLS_MAX",
    "BRAGG_IOR_ACCEPTED",
    "BRAGG_IOR_MAX",
    "BRAGG_LAYERS_MAX",
    "BRAGG_PERIOD_ACCEPTED_NM",
    "BRAGG_PERIOD_MAX_NM",
]

# EXT_materials_bragg, "Limits of Implementations": what every implementation must accept, where files may
# hold more. Of layers and cells it is all that this one draws, too.
BRAGG_LAYERS_MAX = 4
BRAGG_CELLS_MAX = 1000
BRAGG_IOR_ACCEPTED = 4.0
BRAGG_PERIOD_ACCEPTED_NM = 1e4

# No transparent film is as dense.
BRAGG_IOR_MAX = 10.0

# Cells so thick colour nothing: their fringes are finer than any light that is seen is pure.
BRAGG_PERIOD_MAX_NM = 1e5
