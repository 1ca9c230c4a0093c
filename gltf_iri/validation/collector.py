"""Gathers the remarks of one file as the user wants to hear them; enough of them stop the work."""

from __future__ import annotations

from collections.abc import Iterable

from gltf_iri.validation.issue import ERROR, Issue
from gltf_iri.validation.options import Options

__all__ = ["Collector", "EnoughError"]

# What is kept where the user wants all remarks: 3 MB of "{}," could call for two million. Beyond so many,
# errors alone are kept, so that no flood of lesser remarks hides one; twice as many end the work.
_MOST_KEPT = 100_000


class EnoughError(Exception):
    """The user's limit of remarks is reached: no more work on this file."""


class Collector:
    """The remarks so far, in the order they were made."""

    __slots__ = (
        *("_ignore", "_least", "_most", "_most_of_all_kinds", "_only", "_override"),
        *("has_errors", "is_truncated", "issues"),
    )

    def __init__(self, options: Options) -> None:
        self._ignore = options.ignore
        self._only = options.only
        self._override = options.override
        self._least = options.least
        self._most = options.max_issues or 2 * _MOST_KEPT
        self._most_of_all_kinds = options.max_issues or _MOST_KEPT
        self.issues: list[Issue] = []
        self.is_truncated = False
        self.has_errors = False

    def add(self, issue: Issue) -> None:
        """Keep a remark, unless the user does not want to hear it; raises EnoughError beyond the limit."""
        code = issue.code
        if code in self._ignore or (self._only and code not in self._only):
            return
        if code in self._override:
            issue = issue._replace(severity=self._override[code])
        if issue.severity > self._least:
            return
        if len(self.issues) >= self._most_of_all_kinds:
            self.is_truncated = True
            if len(self.issues) >= self._most:
                raise EnoughError
            if issue.severity != ERROR:
                return
        if issue.severity == ERROR:
            self.has_errors = True
        self.issues.append(issue)

    def add_all(self, issues: Iterable[Issue]) -> None:
        """Keep each of `issues`, which may be made as they are taken."""
        for issue in issues:
            self.add(issue)
