"""Errors with a next step for the user."""

from __future__ import annotations

from pathlib import Path


class RoomgraphError(Exception):
    """An expected failure, in one line: what, where, expected, got and the next step.

    Parameters
    ----------
    what : str
        What went wrong, in a few words.
    where : str or Path, optional
        The file (``file:line`` where known), folder, frame or setting concerned.
    expected, got : str, optional
        What was wanted and what was found instead.
    hint : str, optional
        What the user can do next.
    """

    def __init__(
        self,
        what: str,
        *,
        where: str | Path | None = None,
        expected: str | None = None,
        got: str | None = None,
        hint: str | None = None,
    ) -> None:
        self.what, self.where = what, where
        self.expected, self.got, self.hint = expected, got, hint
        super().__init__(str(self))

    def __str__(self) -> str:
        parts = [self.what if self.where is None else f"{self.what}: {self.where}"]
        if self.expected is not None:
            parts.append(f"expected {self.expected}")
        if self.got is not None:
            parts.append(f"got {self.got}")
        if self.hint is not None:
            parts.append(self.hint)
        return "; ".join(parts)


class DatasetError(RoomgraphError):
    """A sequence, an image, a camera or a trajectory cannot be read or written."""
