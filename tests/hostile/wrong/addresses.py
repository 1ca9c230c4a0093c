"""Addresses of buffers and images that must not be followed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from wrong.sound import DROP, Edits


def buffer_at(address: str) -> Edits:
    return {"/buffers/0/uri": address}


EDITED: Final[Mapping[str, Edits]] = {
    "uri-parent": buffer_at("../cases.json"),
    "uri-parent-encoded": buffer_at("%2e%2e/cases.json"),
    "uri-parent-encoded-whole": buffer_at("%2E%2E%2Fcases.json"),
    "uri-parent-in-the-middle": buffer_at("a/../../cases.json"),
    "uri-backslash": buffer_at("..\\cases.json"),
    "uri-absolute": buffer_at("/etc/passwd"),
    "uri-absolute-encoded": buffer_at("%2Fetc/passwd"),
    "uri-network": buffer_at("//localhost/share/a.bin"),
    "uri-drive": buffer_at("C:/Windows/win.ini"),
    "uri-drive-encoded": buffer_at("C%3A/Windows/win.ini"),
    "uri-http": buffer_at("http://127.0.0.1:9/a.bin"),
    "uri-https": {"/images/0/uri": "https://localhost/a.png"},
    "uri-file": buffer_at("file:///etc/passwd"),
    "uri-ftp": buffer_at("FTP://localhost/a.bin"),
    "uri-nul": buffer_at("a.bin%00.png"),
    "uri-not-utf8": buffer_at("%ff.bin"),
    "uri-empty": buffer_at(""),
    "uri-folder": buffer_at("."),
    "uri-missing": buffer_at("missing.bin"),
    "uri-escape-sequence": buffer_at("\x1b[2J\n.bin"),
    "uri-endless": buffer_at("a" * 300),
    "data-uri-without-base64": buffer_at("data:application/octet-stream,AAAA"),
    "data-uri-without-comma": buffer_at("data:application/octet-stream;base64"),
    "data-uri-bad-base64": buffer_at("data:application/octet-stream;base64,AA*A"),
    "buffer-without-bytes": {"/buffers/0/uri": DROP},
}
