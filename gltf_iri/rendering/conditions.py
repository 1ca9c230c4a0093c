"""The part of the GLSL preprocessor that the assembler carries out itself: `#if`, `#ifdef`, `#else`, …

Conditions may only ask whether switches are defined. What is switched off never reaches the driver, and a
file included in a branch that is not taken does not count as included.
"""

from __future__ import annotations

import re
from collections.abc import Set
from typing import Final

from gltf_iri.rendering.switches import SWITCHES

__all__ = ["Conditions", "evaluate_condition", "is_directive"]

_DIRECTIVE: Final = re.compile(r"\s*#\s*(ifdef|ifndef|if|elif|else|endif)\b\s*(.*?)\s*(?://.*)?$")
_TOKEN: Final = re.compile(r"\s*(defined\s*\(\s*(\w+)\s*\)|defined\s+(\w+)|&&|\|\||!|\(|\))")


def is_directive(line: str) -> bool:
    """True where `line` opens, turns or closes a condition."""
    return _DIRECTIVE.match(line) is not None


class Conditions:
    """The nesting of conditions at one point of one file."""

    def __init__(self, defined: Set[str]) -> None:
        self._defined = defined
        # One [is taken now, was taken before, has seen #else] for each open condition.
        self._open: list[list[bool]] = []

    @property
    def active(self) -> bool:
        """True where every open condition is taken."""
        return all(taken for taken, _, _ in self._open)

    @property
    def balanced(self) -> bool:
        """True where no condition is open."""
        return not self._open

    def step(self, line: str) -> None:
        """Take one directive; raises ValueError that says what is wrong with it."""
        match = _DIRECTIVE.match(line)
        if match is None:
            raise ValueError("not a condition")
        keyword, rest = match.groups()
        if keyword in {"if", "ifdef", "ifndef"}:
            if keyword != "if":
                rest = f"{'!' if keyword == 'ifndef' else ''}defined({rest})"
            taken = evaluate_condition(rest, self._defined)
            self._open.append([taken, taken, False])
            return
        if not self._open:
            raise ValueError(f"#{keyword} without #if")
        top = self._open[-1]
        if keyword == "endif":
            self._open.pop()
        elif top[2]:
            raise ValueError(f"#{keyword} after #else")
        else:
            wanted = evaluate_condition(rest, self._defined) if keyword == "elif" else True
            top[0] = wanted and not top[1]
            top[1] = top[1] or wanted
            top[2] = keyword == "else"


def evaluate_condition(text: str, defined: Set[str]) -> bool:
    """Return the truth of `text`, built from defined(SWITCH), !, &&, || and parentheses.

    Raises ValueError for anything else and for a symbol that is no switch.
    """
    tokens: list[str | bool] = []
    position = 0
    while position < len(text.rstrip()):
        match = _TOKEN.match(text, position)
        if match is None:
            raise ValueError(f"'{text}' may only use defined(SWITCH), !, &&, || and parentheses")
        name = match[2] or match[3]
        if name is not None and name not in SWITCHES and name != "GL_ES":
            raise ValueError(f"'{name}' is not a switch that gltf_iri/rendering/switches.py knows")
        tokens.append(match[1] if name is None else name in defined)
        position = match.end()
    value = _any_of(tokens, text)
    if tokens:
        raise ValueError(f"'{text}' has something left over at its end")
    return value


def _any_of(tokens: list[str | bool], text: str) -> bool:
    value = _all_of(tokens, text)
    while tokens and tokens[0] == "||":
        tokens.pop(0)
        value = _all_of(tokens, text) or value
    return value


def _all_of(tokens: list[str | bool], text: str) -> bool:
    value = _atom(tokens, text)
    while tokens and tokens[0] == "&&":
        tokens.pop(0)
        value = _atom(tokens, text) and value
    return value


def _atom(tokens: list[str | bool], text: str) -> bool:
    token = tokens.pop(0) if tokens else ""
    if isinstance(token, bool):
        return token
    if token == "!":
        return not _atom(tokens, text)
    if token == "(":
        value = _any_of(tokens, text)
        if tokens and tokens.pop(0) == ")":
            return value
    raise ValueError(f"'{text}' is not a whole condition")
