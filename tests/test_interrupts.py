"""Signals wait for the end of a block that they could harm, and then do what they would have done."""

from __future__ import annotations

import signal
import sys

import pytest

from gltf_iri.interrupts import interrupts_held


class EndedError(Exception):
    """What the handler raises."""


@pytest.mark.skipif(sys.platform == "win32", reason="the signals are POSIX")
@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_a_signal_comes_after_the_block_and_not_within(name: str) -> None:
    def end(number: int, _: object) -> None:
        raise EndedError

    number = getattr(signal, name)
    before = signal.signal(number, end)
    reached = []
    try:
        with pytest.raises(EndedError), interrupts_held():
            signal.raise_signal(number)
            reached.append("the end of the block")
        assert reached == ["the end of the block"]
        assert signal.getsignal(number) is end
    finally:
        signal.signal(number, before)


@pytest.mark.skipif(sys.platform == "win32", reason="the signals are POSIX")
def test_a_signal_that_nobody_handles_is_not_touched() -> None:
    before = signal.signal(signal.SIGTERM, signal.SIG_DFL)
    try:
        with interrupts_held():
            assert signal.getsignal(signal.SIGTERM) == signal.SIG_DFL
    finally:
        signal.signal(signal.SIGTERM, before)
