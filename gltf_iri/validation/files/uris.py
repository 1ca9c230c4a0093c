"""URIs: which of them are URIs at all (RFC 3986), which are relative, and what data URIs hold (RFC 2397)."""

from __future__ import annotations

import binascii
import re

__all__ = ["DataUri", "InvalidUriError", "Link", "read_uri"]

_SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+.\-]*")
_AUTHORITY = re.compile(r"(?:[^@]*@)?(\[[^\]]*\]|[^:\[\]@]*)(?::-?[0-9]*)?")
_ESCAPE = re.compile(rb"%([0-9A-Fa-f]{2})")
_ESCAPES = re.compile(rb"(?:%[0-9A-Fa-f]{2})+")
# What a path may hold as it is (RFC 3986 §3.3); "%" is looked at by itself.
_TO_ESCAPE = re.compile(rb"[^A-Za-z0-9\-._~!$&'()*+,;=:@/%?#]|%(?![0-9A-Fa-f]{2})")
_UNRESERVED = frozenset(b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~")
_ALPHABET = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"
# Twice what Linux takes as a path, each byte percent-encoded.
_LONGEST_LINK = 24_576

_PART = 65_536

# RFC 2397: what a data URI without media type holds.
_DEFAULT_MEDIA_TYPE = "text/plain"


class InvalidUriError(ValueError):
    """The text is no URI; the message says why."""


class DataUri:
    """A URI that carries its own data: the media type in lower case, and the bytes."""

    __slots__ = ("data", "media_type")

    def __init__(self, media_type: str, data: bytes) -> None:
        self.media_type = media_type
        self.data = data


class Link:
    """A URI that names a file: in normal form, and whether it is relative, with a path alone."""

    __slots__ = ("is_relative", "text")

    def __init__(self, text: str, *, is_relative: bool) -> None:
        self.text = text
        self.is_relative = is_relative


def read_uri(text: str) -> DataUri | Link:
    """Return what a URI is; InvalidUriError where it is none."""
    if text[:5].lower() == "data:":
        return _read_data(text)
    return _read_link(text)


def _read_link(text: str) -> Link:
    if len(text) > _LONGEST_LINK:
        raise InvalidUriError(f"it has more than {_LONGEST_LINK} characters, and no file is called so")
    text = text.replace("\\", "/")  # as browsers read them; the guard refuses what leaves the folder
    end = re.search(r"[/?#]|$", text).start()  # type: ignore[union-attr]  # the end of the text always matches
    scheme, colon, _ = text[:end].partition(":")
    if colon and not _SCHEME.fullmatch(scheme):
        raise InvalidUriError(f"{scheme[:20]!r} before the colon is no scheme")
    rest = text[len(scheme) + 1 :] if colon else text
    if rest.startswith("//"):
        _check_authority(re.split("[/?#]", rest[2:], maxsplit=1)[0])
    is_relative = not colon and not text.startswith("/") and "?" not in text and "#" not in text
    normal = _escaped(f"{scheme.lower()}:{rest}" if colon else text)
    return Link(_without_dots(normal) if is_relative else normal, is_relative=is_relative)


def _check_authority(authority: str) -> None:
    match = _AUTHORITY.fullmatch(authority)
    if match is None:
        raise InvalidUriError("its host and port are broken")
    if match[1].startswith("["):
        # Imported only here: hardly any file names a host, and none is ever asked.
        from ipaddress import AddressValueError, IPv6Address

        try:
            IPv6Address(match[1][1:-1].partition("%")[0])
        except AddressValueError as error:
            raise InvalidUriError("its IPv6 address is broken") from error


def _escaped(text: str) -> str:
    """Percent-encode what must be, and undo what need not be (RFC 3986 §6.2.2)."""
    raw = text.encode("utf-8", "surrogatepass")
    raw = _TO_ESCAPE.sub(lambda match: b"%%%02X" % match[0][0], raw)
    return _ESCAPE.sub(_normal_escape, raw).decode("ascii")


def _normal_escape(match: re.Match[bytes]) -> bytes:
    byte = int(match[1], 16)
    return bytes((byte,)) if byte in _UNRESERVED else match[0].upper()


def _without_dots(path: str) -> str:
    """Take "." and ".." out of a relative path where a folder stands before them (RFC 3986 §5.2.4)."""
    if "." not in path.split("/") and ".." not in path.split("/"):
        return path
    kept: list[str] = []
    step = ""
    for step in path.split("/"):
        if step == ".." and kept and kept[-1] != "..":
            kept.pop()
        elif step != ".":
            kept.append(step)
    ends_in_folder = step in (".", "..")
    if not kept or kept == [""]:
        return "./"
    return "/".join(kept) + ("/" if ends_in_folder else "")


def _read_data(text: str) -> DataUri:
    comma = text.find(",")
    if comma < 0:
        raise InvalidUriError("no comma follows its media type")
    media_type, *parameters = text[5:comma].split(";")
    is_base64 = bool(parameters) and parameters[-1] == "base64"
    if is_base64:
        parameters.pop()
    if media_type.count("/") != 1 and media_type:
        raise InvalidUriError(f"{media_type[:40]!r} is no media type")
    for parameter in parameters:
        if "=" not in parameter:
            raise InvalidUriError(f"the parameter {parameter[:40]!r} has no value")
    encoded = text[comma + 1 :]
    named = _unescaped(media_type).decode("latin-1").lower() if media_type else _DEFAULT_MEDIA_TYPE
    return DataUri(named, _from_base64(encoded) if is_base64 else _unescaped(encoded))


def _unescaped(text: str) -> bytes:
    raw = text.encode("utf-8", "surrogatepass")
    if b"%" not in raw:
        return raw
    # In parts, because a match takes more memory than its bytes; none ends within an escape.
    parts, start = [], 0
    while start < len(raw):
        end = start + _PART
        cut = raw.rfind(b"%", end - 2, end) if end < len(raw) else -1
        end = end if cut < 0 else cut
        parts.append(_ESCAPES.sub(_decoded, raw[start:end]))
        start = end
    return b"".join(parts)


def _decoded(match: re.Match[bytes]) -> bytes:
    return bytes.fromhex(match[0].replace(b"%", b"").decode("ascii"))


def _from_base64(text: str) -> bytes:
    """Decode base64 in either alphabet (RFC 4648 §4, §5); the padding may be left out, but not be wrong."""
    if "%" in text:
        text = _unescaped(text).decode("latin-1")
    if "-" in text or "_" in text:
        text = text.replace("-", "+").replace("_", "/")
    digits = len(text.rstrip("=")) if text.endswith("=") else len(text)
    beyond = digits % 4
    if beyond == 1 or len(text) not in (digits, digits + -digits % 4):
        raise InvalidUriError("its base64 ends in the wrong place")
    if beyond and _ALPHABET.find(text[digits - 1]) & (15 if beyond == 2 else 3):
        raise InvalidUriError("its base64 ends in a digit with bits that mean nothing")
    if len(text) == digits:
        text += "=" * (-digits % 4)
    try:
        return binascii.a2b_base64(text, strict_mode=True)
    except ValueError as error:
        raise InvalidUriError("its base64 has characters that do not belong") from error
