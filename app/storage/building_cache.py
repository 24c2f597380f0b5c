"""Rendered buildings on disk: written where asked for, or kept in a cache."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydantic import ValidationError

import roomgraph.datasets.synthetic
from roomgraph.app.console import Terminal
from roomgraph.app.errors import AppError
from roomgraph.datasets.files import replacing
from roomgraph.datasets.synthetic.settings import BuildingSettings, Light


def building_settings(**values: Any) -> BuildingSettings:
    """Return checked settings of a building.

    Raises
    ------
    AppError
        A value is out of range.
    """
    try:
        return BuildingSettings(**values)
    except ValidationError as error:
        first = error.errors()[0]
        raise AppError(
            "building cannot be rendered", where=_option(first["loc"]),
            expected=first["msg"].removeprefix("Value error, ").removeprefix("Input should be "),
            got=_told(first["input"]),
        ) from error  # fmt: skip


def _option(place: tuple[int | str, ...]) -> str | None:
    """Return the option that a setting is given by; None for what several settle together."""
    return f"--{place[0]}".replace("_m", "") if place else None


def _told(value: Any) -> str:
    if isinstance(value, dict):
        return ", ".join(f"{name} {value[name]}" for name in ("plan", "floors", "visit"))
    return repr(value)


def render(
    directories: Mapping[Light, Path], settings: BuildingSettings, terminal: Terminal
) -> None:
    """Render one walk in one or several lights, a folder each, with a progress bar."""
    from roomgraph.datasets.synthetic.writer import write_sequences

    title = f"Rendering building {settings.seed} ({', '.join(directories)})"
    with terminal.progress(title, "frames") as advance:
        write_sequences(
            directories, settings, lambda done, total: advance(done, total, ""),
            _cache_root() / "scenes",
        )  # fmt: skip


def draw_sheet(
    output: Path, settings: BuildingSettings, overwrite: bool, terminal: Terminal
) -> Path:
    """Draw a page of pictures of a building into a folder; return the file.

    Raises
    ------
    AppError
        The page is there already, and not to be overwritten.
    """
    import cv2

    from roomgraph.datasets.synthetic.sheet import draw_page
    from roomgraph.datasets.synthetic.world import make_world

    floors = f"_{settings.floors}floors" if settings.floors > 1 else ""
    visit = f"_visit{settings.visit}" if settings.visit else ""
    path = output / f"{settings.plan}{settings.seed}{floors}{visit}.jpg"
    if path.exists() and not overwrite:
        raise AppError(
            "page is there already", where=path, hint="overwrite it with --overwrite, or name "
            "another folder with -o",
        )  # fmt: skip
    with terminal.progress(f"Drawing building {settings.seed} ({settings.plan})", "rooms") as step:
        page = draw_page(make_world(settings), lambda done, total: step(done, total, ""))
    output.mkdir(parents=True, exist_ok=True)
    with replacing(path) as temporary:
        bgr = cv2.cvtColor(page, cv2.COLOR_RGB2BGR)
        _, data = cv2.imencode(".jpg", bgr, [cv2.IMWRITE_JPEG_QUALITY, 82])
        temporary.write_bytes(data.tobytes())  # Unlike cv2.imwrite, this says when a disk is full.
    return path


def cached(lights: tuple[Light, ...], settings: BuildingSettings, terminal: Terminal) -> list[Path]:
    """Return the sequences of a building in some lights, rendering those not in the cache.

    The cache's folder names hold a digest of settings and renderer, so that nothing stale is used.
    """
    digest = _digest(settings)
    root = _cache_root() / "buildings"
    root.mkdir(parents=True, exist_ok=True)
    directories = {light: root / f"building{settings.seed}-{light}-{digest}" for light in lights}
    missing = {light: path for light, path in directories.items() if not path.exists()}
    if missing:
        render(missing, settings, terminal)
    else:
        terminal.say(f"Building {settings.seed} ({', '.join(lights)}) from {root}", dim=True)
    return list(directories.values())


def _digest(settings: BuildingSettings) -> str:
    digest = hashlib.sha256(settings.model_dump_json(exclude={"light"}).encode())
    for path in sorted(Path(roomgraph.datasets.synthetic.__file__).parent.rglob("*.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:10]


def _cache_root() -> Path:
    named = os.environ.get("ROOMGRAPH_CACHE")
    if named:
        return Path(named)
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "roomgraph"
