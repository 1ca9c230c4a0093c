"""What the user wants to hear: codes left out, severities changed, how many remarks at most."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from gltf_iri.validation.issue import HINT

__all__ = ["DEFAULT_MAX_ISSUES", "Options"]

# All: what stops before the last remark may stop before the first error.
DEFAULT_MAX_ISSUES = 0


class Options:
    """How a file is judged; the same names as the Khronos validator's configuration.

    ignore, only : codes to leave out, or to tell alone; not both.
    override : code to severity, 0 (error) to 3 (hint).
    least : the least severity to tell, as a number; after `override`.
    max_issues : stop after so many remarks; 0 for all.
    optics : measure, in ΔE, what the remarks about films and layers mean; takes numpy and seconds.
    resources : read buffers and pictures, and look at what they hold.
    raises : let the exceptions of a rule through, for those who write one; otherwise each becomes a remark.
    """

    __slots__ = ("ignore", "least", "max_issues", "only", "optics", "override", "raises", "resources")

    def __init__(
        self,
        *,
        ignore: frozenset[str] = frozenset(),
        only: frozenset[str] = frozenset(),
        override: Mapping[str, int] = MappingProxyType({}),
        least: int = HINT,
        max_issues: int = DEFAULT_MAX_ISSUES,
        optics: bool = False,
        resources: bool = True,
        raises: bool = False,
    ) -> None:
        self.ignore = ignore
        self.only = only
        self.override = dict(override)
        self.least = least
        self.max_issues = max_issues
        self.optics = optics
        self.resources = resources
        self.raises = raises
