# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Ends a process even if it hangs."""

import ctypes
import time

LIBRARY = 'librt.so.1'  # with the C library, in which newer ones have the timers
SIGEV_THREAD = 2  # of <signal.h>: the timer calls a function in a thread of its own


class _Event(ctypes.Structure):
    """`struct sigevent`: what a timer does."""

    _fields_ = (
        ('value', ctypes.c_void_p),
        ('signal', ctypes.c_int),
        ('notify', ctypes.c_int),
        ('function', ctypes.c_void_p),
        ('attributes', ctypes.c_void_p),
        ('rest', ctypes.c_byte * 32),
    )


def exit_after(seconds: float, status: int) -> None:
    """End this process with a status some seconds from now, unless it has ended by then.

    No thread of Python could: what hangs may hold the interpreter's lock.
    """
    library = ctypes.CDLL(LIBRARY)
    leave = ctypes.cast(library._exit, ctypes.c_void_p)
    event = _Event(value=status, notify=SIGEV_THREAD, function=leave)
    timer = ctypes.c_void_p()
    whole, rest = divmod(round(seconds * 1e9), 1_000_000_000)
    once = (ctypes.c_long * 4)(0, 0, whole, rest)
    if library.timer_create(time.CLOCK_MONOTONIC, ctypes.byref(event), ctypes.byref(timer)) == 0:
        library.timer_settime(timer, 0, once, None)
