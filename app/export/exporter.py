"""The interface of an export format."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from roomgraph.app.errors import AppError
from roomgraph.app.storage.run_folder import RunFolder

Notes = tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Exporter:
    """A format to which an output of a run can be exported.

    Attributes
    ----------
    kind : str
        Of product: ``trajectory``, ``cloud``, ``mesh`` ...
    meaning : str
        What is written, and who reads it, in a few words.
    file_name : str
        What the file is called if nothing else is asked for.
    write : callable
        Writes a run's product to a path; returns what the user should know.
    beside : callable
        The further files that come with a path.
    """

    kind: str
    meaning: str
    file_name: str
    write: Callable[[RunFolder, Path], Notes]
    beside: Callable[[Path], tuple[Path, ...]] = lambda path: ()


def product(path: Path, hint: str | None = None) -> Path:
    """Return a product's path.

    Raises
    ------
    AppError
        The run does not have it.
    """
    if not path.exists():
        raise AppError(
            "the run has no such output", where=path, expected="a finished run",
            got="no such file", hint=hint,
        )  # fmt: skip
    return path


def named(path: Path, *suffixes: str) -> Path:
    """Return a path with the extension of its format, which some writers require.

    Raises
    ------
    AppError
        It ends otherwise.
    """
    if path.suffix not in suffixes:
        raise AppError(
            "wrong file extension", where=path,
            expected=" or ".join(f"NAME{suffix}" for suffix in suffixes),
        )  # fmt: skip
    return path


def missing_package(package: str) -> AppError:
    """Return the error for an optional package that is not installed."""
    return AppError(
        f"the package {package} is not installed", where="roomgraph export",
        hint=f"install it with: pip install {package}",
    )  # fmt: skip
