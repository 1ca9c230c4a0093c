"""Ctrl-C and the signals that end a process, kept waiting for the moments in which they would do harm."""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager

__all__ = ["interrupts_held"]

# Windows has no SIGHUP.
_ENDINGS = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]


@contextmanager
def interrupts_held() -> Iterator[None]:
    """Keep the signals waiting while the block runs, and Ctrl-C for ever from the processes that it starts.

    A terminal sends Ctrl-C to all of them: those would each print a traceback where the first says one
    sentence, and one that is only half started would outlive it. A library that is interrupted in the middle
    of calling back may crash, whichever signal it is.
    """
    if sys.platform == "win32":  # where there are no masks
        yield
        return
    # The mask is for the processes, which inherit it. Here another thread takes the signal all the same.
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    held = {}
    came: list[int] = []
    if threading.current_thread() is threading.main_thread():
        held = {n: h for n in _ENDINGS if callable(h := signal.getsignal(n))}
        for number in held:
            signal.signal(number, lambda number, _: came.append(number))
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        for number, handler in held.items():
            signal.signal(number, handler)
        if came:
            signal.raise_signal(came[0])
