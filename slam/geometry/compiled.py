"""Loops compiled to machine code, where NumPy would take many small steps or large copies."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

import numba

Function = TypeVar("Function", bound=Callable[..., Any])


def compiled(function: Function) -> Function:
    """Compile a function of numbers and arrays when it is first called; others may run meanwhile.

    The outcome is kept beside its file, or in the user's cache folder, until that file changes:
    so it may only call compiled functions of its own file.
    """
    options: dict[str, Any] = {"nogil": True, "error_model": "numpy"}
    try:
        quick: Function = numba.njit(function, cache=True, **options)
    except RuntimeError:  # There is no folder that it could be kept in.
        quick = numba.njit(function, **options)
    return quick
