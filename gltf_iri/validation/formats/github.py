"""Reports as workflow commands of GitHub Actions, which show them beside the lines of a pull request."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from gltf_iri.asset.words import printable
from gltf_iri.validation.formats.judged import Judged
from gltf_iri.validation.issue import ERROR, WARNING

__all__ = ["written"]

_COMMANDS = {ERROR: "error", WARNING: "warning"}


def written(files: Iterable[Judged]) -> Iterator[str]:
    """Yield a command for each remark; information and hints are notices."""
    for file in files:
        for message, line in zip(file.messages, file.lines(), strict=True):
            place = f"byte {message['offset']}" if "offset" in message else message.get("pointer", "")
            told = f"{place}: {message['message']}" if place else message["message"]
            where = f"file={_property(file.path)},line={line or 1},title={_property(message['code'])}"
            yield f"::{_COMMANDS.get(message['severity'], 'notice')} {where}::{_data(told)}\n"


def _data(text: str) -> str:
    """Escape a command's text: "%" first; line ends, which would begin a new command, are gone already."""
    return printable(text).replace("%", "%25")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
