"""Words for errors: JSON Pointers and values, made safe to print."""

from __future__ import annotations

__all__ = ["join", "kind_of", "printable", "shown"]

_LONGEST = 60

_KINDS: dict[type, str] = {
    dict: "an object",
    list: "an array",
    str: "text",
    bool: "true or false",
    int: "a number",
    float: "a number",
    type(None): "null",
}


def join(pointer: str, key: str | int) -> str:
    """Append one token to a JSON Pointer (RFC 6901), escaping what a terminal must not receive."""
    token = str(key).replace("~", "~0").replace("/", "~1")
    if not token.isprintable():
        token = token.encode("unicode_escape", "backslashreplace").decode("ascii")
    return f"{pointer}/{_shortened(token)}"


def shown(value: object, longest: int = _LONGEST) -> str:
    """Quote a value of the file: escaped, and cut where it is long (a data URI may have megabytes)."""
    if isinstance(value, dict | list):
        return kind_of(value)
    if value is None or isinstance(value, bool):
        return {None: "null", True: "true", False: "false"}[value]
    return _shortened(repr(value[: 2 * longest] if isinstance(value, str) else value), longest)


def kind_of(value: object) -> str:
    """Name the JSON type of a parsed value."""
    return _KINDS[type(value)]


def printable(text: str) -> str:
    """Return `text` on one line and without control characters or lone surrogates.

    Names come from untrusted files; an escape sequence in one would control the terminal.
    """
    if text.isprintable():
        return text
    return "".join(
        c if c.isprintable() else " " if c.isspace() else "\N{REPLACEMENT CHARACTER}" for c in text
    )


def _shortened(text: str, longest: int = _LONGEST) -> str:
    return text if len(text) <= longest else f"{text[: longest - 1]}…"
