"""Atomic writing of files, safe even in a power failure."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Give a temporary name beside `path`; rename it to `path` when the block ends well.

    The bytes are on the disk before the new name is, or a crash could leave an empty file.
    """
    temporary = path.with_name(f".{path.stem}.{os.getpid()}{path.suffix}")
    try:
        yield temporary
        with temporary.open("rb+") as file:
            os.fsync(file.fileno())
        temporary.replace(path)
        _flush_folder(path.parent)
    finally:
        temporary.unlink(missing_ok=True)


def write_text(path: Path, text: str) -> None:
    """Write UTF-8 text through a temporary file."""
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def is_working_folder(path: Path) -> bool:
    """Whether a path is the folder that the process works in: it cannot be replaced."""
    return path.resolve() == Path.cwd()


def replace_folder(fresh: Path, path: Path) -> None:
    """Replace `path`, if it exists, by the finished folder `fresh`.

    Both lie beside each other. The files are on the disk before the folder has its name: all at
    once, as they may be many. An old folder is only removed once the new one stands; if that
    fails, it is put back.
    """
    if hasattr(os, "sync"):
        os.sync()
    old = path.with_name(f".{path.name}.old.{os.getpid()}")
    if path.exists():
        path.replace(old)
    try:
        fresh.replace(path)
    except OSError:
        if old.exists():
            old.replace(path)
        raise
    _flush_folder(path.parent)
    shutil.rmtree(old, ignore_errors=True)


def _flush_folder(folder: Path) -> None:
    """Flush a folder to disk, if the system supports it."""
    with suppress(OSError):
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
