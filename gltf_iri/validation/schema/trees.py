"""The trees that nodes form by their children, and the loops where they fail to, in linear time."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.entry import Entry

__all__ = ["Trees"]

# A node whose way to the top is not known yet, and one that lies on the way that is just being walked.
_UNKNOWN, _ON_THE_WAY = -1, -2


class Trees:
    """Parents and tops of all nodes, by index.

    parents : the parent of each node, None where it has none; of several, the last in the file.
    tops : the topmost ancestor of each node; where ancestors form a loop, one node of the loop.
    is_in_loop : whether a node is its own ancestor.
    overrides : (node, position, child) of all children that had a parent before.
    """

    def __init__(self, nodes: list[Entry | None]) -> None:
        self.parents: list[int | None] = [None] * len(nodes)
        self.overrides: list[tuple[int, int, int]] = []
        for index, node in enumerate(nodes):
            for position, child in enumerate(node.get("children", ()) if node is not None else ()):
                if child is None:
                    continue
                if self.parents[child] is not None:
                    self.overrides.append((index, position, child))
                self.parents[child] = index
        self.tops = [_UNKNOWN] * len(nodes)
        self.is_in_loop = [False] * len(nodes)
        for index in range(len(nodes)):
            self._find_top(index)
        self._spans: list[tuple[int, int]] = []

    def _find_top(self, start: int) -> None:
        """Walk up from a node to the first whose top is known, and let all on the way know theirs."""
        way: list[int] = []
        node: int | None = start
        while node is not None and self.tops[node] == _UNKNOWN:
            self.tops[node] = _ON_THE_WAY
            way.append(node)
            node = self.parents[node]
        if not way:
            return
        if node is None:
            top = way[-1]
        elif self.tops[node] == _ON_THE_WAY:
            top = node
            for member in way[way.index(node) :]:
                self.is_in_loop[member] = True
        else:
            top = self.tops[node]
        for member in way:
            self.tops[member] = top

    def is_above(self, ancestor: int, node: int) -> bool:
        """Tell whether `node` is `ancestor` or lies below it."""
        if self.tops[ancestor] != self.tops[node]:
            return False
        if self.is_in_loop[ancestor]:
            return True
        if not self._spans:
            self._spans = self._numbered()
        first, last = self._spans[ancestor]
        return first <= self._spans[node][0] <= last

    def _numbered(self) -> list[tuple[int, int]]:
        """Number the nodes from the tops down, so that what lies below a node has the numbers of a span."""
        children: list[list[int]] = [[] for _ in self.parents]
        for node, parent in enumerate(self.parents):
            if parent is not None and not self.is_in_loop[node]:
                children[parent].append(node)
        spans = [(0, 0)] * len(children)
        number = 0
        for start in self._starts():
            open_nodes = [(start, False)]
            while open_nodes:
                node, is_done = open_nodes.pop()
                if is_done:
                    spans[node] = (spans[node][0], number)
                else:
                    number += 1
                    spans[node] = (number, number)
                    open_nodes.append((node, True))
                    open_nodes.extend((child, False) for child in children[node])
        return spans

    def _starts(self) -> Iterator[int]:
        """Yield the nodes that no other is above, and those of loops."""
        for node, parent in enumerate(self.parents):
            if parent is None or self.is_in_loop[node]:
                yield node
