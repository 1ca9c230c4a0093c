"""Ctrl-C, kept waiting for the moments in which it would do harm."""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager

__all__ = ["interrupts_held"]


@contextmanager
def interrupts_held() -> Iterator[None]:
    """Keep Ctrl-C waiting while the block runs, and for ever from the processes that it starts.

    A terminal sends it to all of them: those would each print a traceback where the first says one sentence,
    and one that is only half started would outlive it. A library that is interrupted in the middle of calling
    back may crash.
    """
    if sys.platform == "win32":  # where there are no masks
        yield
        return
    # The mask is for the processes, which inherit it. Here another thread takes the signal all the same.
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    handler = signal.getsignal(signal.SIGINT)
    holds = callable(handler) and threading.current_thread() is threading.main_thread()
    came: list[int] = []
    if holds:
        signal.signal(signal.SIGINT, lambda number, _: came.append(number))
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        if holds:
            signal.signal(signal.SIGINT, handler)
        if came:
            signal.raise_signal(signal.SIGINT)
