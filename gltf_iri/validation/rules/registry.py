"""Which rules look at which objects.

A rule takes an entry and the asset, and yields remarks (`codes.issue`). What the schema told is absent from
the entry, and every index in it exists. Each module of this folder states its own `RULES`, table name to
rules, and `DATA_RULES`, which run after buffers and pictures were read.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from gltf_iri.validation.asset import Asset
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.issue import Issue

__all__ = ["DATA_RULES", "RULES", "Rule", "Rules", "add_data_rules", "add_rules"]

Rule = Callable[[Entry, Asset], Iterator[Issue]]
Rules = Mapping[str, tuple[Rule, ...]]

RULES: dict[str, tuple[Rule, ...]] = {}
DATA_RULES: dict[str, tuple[Rule, ...]] = {}


def add_rules(rules: Rules) -> None:
    """Let `rules` look at every object of their tables, after the rules that are there."""
    _add(RULES, rules)


def add_data_rules(rules: Rules) -> None:
    """Let `rules` look at every object of their tables once its data is there."""
    _add(DATA_RULES, rules)


def _add(known: dict[str, tuple[Rule, ...]], rules: Rules) -> None:
    for table, added in rules.items():
        known[table] = (*known.get(table, ()), *added)
