"""What a sample is: a few files, and the words that say what to look for in them."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping
from dataclasses import dataclass

__all__ = ["Sample"]


@dataclass(frozen=True, slots=True)
class Sample:
    """One asset of the collection; its folder, called `name`, holds `files`, a picture and the README."""

    name: str
    title: str
    shows: str  # one sentence, the line of index.json
    look_for: str  # paragraphs of the README
    sources: str  # where the numbers come from, a paragraph of the README
    files: Mapping[str, bytes]  # file name → content; the first one is the asset itself
    fallback: str = ""  # what a renderer shows that ignores EXT_materials_bragg, a paragraph of the README

    @property
    def file(self) -> str:
        """Path of the asset itself, relative to the collection."""
        return f"{self.name}/{next(iter(self.files))}"

    @property
    def picture(self) -> str:
        """Name of the picture that the README shows."""
        return f"{self.name}.webp"

    @property
    def readme(self) -> str:
        """Text of the sample's README.md."""
        parts = [
            f"# {self.title}",
            f"![{self.title}]({self.picture})",
            self.shows,
            "## What to look for",
            self.look_for,
        ]
        parts += ["## Without the extension", self.fallback] if self.fallback else []
        parts += ["## Numbers", self.sources]
        paragraphs = "\n\n".join(parts).split("\n\n")
        return "\n\n".join(textwrap.fill(p, 100, break_on_hyphens=False) for p in paragraphs) + "\n"
