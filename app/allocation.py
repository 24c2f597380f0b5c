"""Memory allocation of the process, tuned for images of equal size."""

from __future__ import annotations

import ctypes
import gc

# Objects made from one look for garbage to the next. Nearly all that is loaded and mapped is for
# keeps: by Python's own number, 700, looking through it again and again stops a run for 0.1 s each.
GARBAGE_EVERY = 10_000
# What the C library keeps instead of giving it back, bytes; and the largest piece that it keeps
# (the most that glibc takes). The next frame needs the same again: fetched from the system page by
# page, that takes a twentieth of a run.
KEEP_BYTES, KEEP_PIECE_BYTES = 1 << 30, 32 << 20
# Their names in glibc's malloc.h.
_M_TRIM_THRESHOLD, _M_MMAP_THRESHOLD = -1, -3


def keep_memory() -> None:
    """Keep freed memory in the process, if the C library has such a setting."""
    gc.set_threshold(GARBAGE_EVERY)
    try:
        mallopt = ctypes.CDLL(None).mallopt
    except (AttributeError, OSError, TypeError):  # another C library; Windows has none by no name
        return
    mallopt(_M_TRIM_THRESHOLD, KEEP_BYTES)
    mallopt(_M_MMAP_THRESHOLD, KEEP_PIECE_BYTES)
