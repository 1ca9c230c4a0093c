"""The Khronos validator beside ours: runs the npm package gltf-validator and holds both verdicts together."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from gltf_iri.asset.limits import MAX_FILE_BYTES
from gltf_iri.asset.words import printable
from gltf_iri.errors import MissingCapabilityError
from gltf_iri.validation.collector import Collector, EnoughError
from gltf_iri.validation.issue import SEVERITY_NAMES, Issue
from gltf_iri.validation.options import Options
from gltf_iri.validation.report import Report

__all__ = ["KhronosValidator", "Verdict", "find_khronos"]

PACKAGE = "gltf-validator"
_SCRIPT = Path(__file__).with_name("khronos.js")

# Its slowest file of real assets takes some seconds.
_TIME_LIMIT_S = 60
# Before the user's own choice among them; without a bound, its report of a hostile file has gigabytes.
_MOST_ISSUES = 10_000


class Verdict:
    """What the Khronos validator said of one file, or the reason why it said nothing."""

    __slots__ = ("failure", "report")

    def __init__(self, report: dict[str, Any] | None, failure: str | None = None) -> None:
        self.report = report
        self.failure = failure

    def agrees(self, ours: dict[str, Any]) -> bool:
        """Tell whether both validators find errors, or neither does."""
        theirs = self.report
        return theirs is not None and bool(theirs["issues"]["numErrors"]) == bool(ours["issues"]["numErrors"])

    def differences(self, ours: dict[str, Any]) -> tuple[list[str], list[str]]:
        """Return codes that only we and only they tell of some place, "CODE" or "CODE ×2"."""
        here, there = _places(ours), _places(self.report)
        return _told(here - there), _told(there - here)

    def lines(self, ours: dict[str, Any]) -> Iterator[str]:
        """Yield both verdicts side by side as lines of text."""
        if self.report is None:
            yield f"  Khronos: no verdict, {printable(self.failure or '')}.\n"
            return
        yield f"  {'':10}{''.join(f'{name:>12}' for name in SEVERITY_NAMES)}\n"
        for name, report in (("gltf-iri", ours), ("Khronos", self.report)):
            counts = (report["issues"][key] for key in ("numErrors", "numWarnings", "numInfos", "numHints"))
            yield f"  {name:10}{''.join(f'{count:>12}' for count in counts)}\n"
        for name, codes in zip(("gltf-iri", "Khronos"), self.differences(ours), strict=True):
            if codes:
                yield f"  only {name}: {', '.join(codes)}\n"

    def to_json(self, ours: dict[str, Any]) -> dict[str, Any]:
        """Return the verdict: its report or the failure, and the codes that only one tells."""
        if self.report is None:
            return {"failure": self.failure}
        only_here, only_there = self.differences(ours)
        return {"report": self.report, "onlyGltfIri": only_here, "onlyKhronos": only_there}


class KhronosValidator:
    """The package as it was found; each file is judged in a process of its own, which a file may kill."""

    __slots__ = ("_node", "_package")

    def __init__(self, node: str, package: Path) -> None:
        self._node = node
        self._package = package

    def judge(self, data: bytes, uri: str, folder: Path | None, options: Options) -> Verdict:
        """Judge `data`, with other files read from `folder` only; `options` choose as they do for us."""
        settings = {
            "folder": None if folder is None else str(folder),
            "maxBytes": MAX_FILE_BYTES,
            "maxIssues": _MOST_ISSUES,
            "uri": uri,
        }
        command = [self._node, str(_SCRIPT), str(self._package), json.dumps(settings)]
        try:
            done = subprocess.run(
                command, input=data, capture_output=True, timeout=_TIME_LIMIT_S, check=False
            )
        except subprocess.TimeoutExpired:
            return Verdict(None, f"it had not ended after {_TIME_LIMIT_S} s")
        if done.returncode != 0:
            return Verdict(None, f"it broke down: {_reason(done.stderr)}")
        return Verdict(_chosen(json.loads(done.stdout), options))


def find_khronos() -> KhronosValidator:
    """Return the package from this folder's node_modules, NODE_PATH, or npm's global folder.

    Raises MissingCapabilityError, which says what to install.
    """
    node = shutil.which("node")
    if node is None:
        raise MissingCapabilityError(
            "The Khronos validator needs Node.js, which is not found: install it from nodejs.org or as the "
            f"system's package 'nodejs', then type 'npm install {PACKAGE}'."
        )
    for folder in _folders():
        if (folder / PACKAGE / "package.json").is_file():
            return KhronosValidator(node, (folder / PACKAGE).resolve())
    raise MissingCapabilityError(
        f"The npm package {PACKAGE} is not found in this folder, NODE_PATH or npm's global folder: "
        f"type 'npm install {PACKAGE}' here, or 'npm install -g {PACKAGE}'."
    )


def _folders() -> Iterator[Path]:
    yield Path.cwd() / "node_modules"
    yield from (Path(folder) for folder in os.environ.get("NODE_PATH", "").split(os.pathsep) if folder)
    npm = shutil.which("npm")
    if npm is not None:  # last: npm takes a quarter of a second to answer
        done = subprocess.run([npm, "root", "-g"], capture_output=True, text=True, check=False)
        if done.returncode == 0 and done.stdout.strip():
            yield Path(done.stdout.strip())


def _chosen(report: dict[str, Any], options: Options) -> dict[str, Any]:
    """Return their report with what the user wants to hear, by our own rules for that."""
    collector = Collector(options)
    told = report["issues"]
    try:
        for message in told["messages"]:
            place = (message.get("pointer"), message.get("offset"))
            is_unread = message["code"] == "IO_ERROR" and not options.resources
            if not is_unread:
                collector.add(Issue(message["code"], message["message"], message["severity"], *place))
    except EnoughError:
        told["truncated"] = True
    issues = Report("", None, tuple(collector.issues), is_truncated=told["truncated"]).to_json()["issues"]
    return {**report, "issues": issues}


def _places(report: dict[str, Any] | None) -> Counter[tuple[str, Any]]:
    messages = report["issues"]["messages"] if report is not None else []
    # Once for each place: we may say in one sentence what they say in two.
    return Counter(
        {(message["code"], message.get("offset", message.get("pointer"))): 1 for message in messages}
    )


def _told(places: Counter[tuple[str, Any]]) -> list[str]:
    codes = Counter(code for code, _ in places)
    return [code if count == 1 else f"{code} ×{count}" for code, count in sorted(codes.items())]


def _reason(stderr: bytes) -> str:
    """Return the line of Node.js' output that names the error."""
    lines = [line.strip() for line in stderr.decode("utf-8", "replace").splitlines() if line.strip()]
    named = [line for line in lines if "Error" in line.split(":")[0]]
    return (named or lines or ["it gave no reason"])[0][:200]
