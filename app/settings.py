"""All settings. A flag overrides the TOML file, which overrides the default."""

from __future__ import annotations

import tomllib
from collections.abc import Collection, Mapping
from difflib import get_close_matches
from pathlib import Path
from typing import Any

import tomli_w
from pydantic import Field, ValidationError

from roomgraph.app.errors import AppError
from roomgraph.app.renamed_settings import new_name, old_name
from roomgraph.datasets.files import write_text
from roomgraph.datasets.settings import Settings
from roomgraph.semantics.settings import SemanticsSettings
from roomgraph.slam.checks import CheckSettings
from roomgraph.slam.settings import SlamSettings


class RecordingSettings(Settings):
    """What is written and drawn during a run."""

    map_every: int = Field(
        default=16,
        ge=2,
        description="minimum number of keyframes between updates of the displayed map; for a "
        "large map, a 16th of its keyframes",
    )
    checkpoint_every: int = Field(
        default=200, ge=1, description="number of frames after which the trajectory so far is saved"
    )


class ViewerSettings(Settings):
    """How much the Rerun recording holds."""

    frame_every_s: float = Field(
        default=0.2, ge=0,
        description="time between displayed frames, seconds; the last frame and those where "
        "tracking is lost or recovered are always shown",
    )  # fmt: skip
    depth_every_s: float = Field(
        default=0.4, ge=0, description="time between displayed depth images, seconds"
    )
    jpeg_quality: int = Field(
        default=75, ge=10, le=100, description="JPEG quality of the colour images"
    )
    depth_step: int = Field(
        default=3,
        ge=1,
        le=16,
        description="every n-th row and column of the depth image is displayed",
    )
    max_keypoints: int = Field(
        default=400,
        ge=0,
        description="maximum number of features drawn per frame; the strongest are drawn",
    )
    picture_spacing_m: float = Field(
        default=1.5,
        gt=0,
        description="minimum distance between keyframe pictures in the map, metres",
    )
    picture_turn_deg: float = Field(
        default=90.0, gt=0, le=180, description="or minimum rotation between nearer ones, degrees"
    )
    max_points: int = Field(
        default=60_000, ge=1000, description="maximum number of points of each online map"
    )
    max_points_total: int = Field(
        default=1_500_000, ge=0, description="maximum number of points of all online maps together"
    )
    max_points_final: int = Field(
        default=300_000, ge=1000, description="maximum number of points of the final map"
    )
    point_radius_m: float = Field(
        default=0.013, gt=0, le=1, description="radius of the final map's points, metres"
    )
    headroom_m: float = Field(
        default=0.7,
        gt=0,
        description="points higher than this above the path are hidden (the ceiling), metres",
    )
    port: int = Field(default=9876, ge=1024, le=65535, description="port of the live viewer")


class AppSettings(Settings):
    """All settings of a run."""

    seed: int = Field(default=0, ge=0, description="seed of all random choices")
    slam: SlamSettings = SlamSettings()
    semantics: SemanticsSettings = SemanticsSettings()
    viewer: ViewerSettings = ViewerSettings()
    recording: RecordingSettings = RecordingSettings()
    checks: CheckSettings = CheckSettings()


def load_settings(
    path: Path | None = None,
    flags: Mapping[str, Any] | None = None,
    only: Collection[str] | None = None,
) -> AppSettings:
    """Return the settings of a TOML file, overridden by flags.

    Parameters
    ----------
    path : Path, optional
        A file like `roomgraph config` prints; what it leaves out keeps its default.
    flags : mapping, optional
        Values by dotted name (``"slam.max_depth_m"``); None means not given.
    only : collection of str, optional
        Dotted names of what is read of the file: a run made by another version may have others.

    Raises
    ------
    AppError
        The file cannot be read, or a name or value is not allowed.
    """
    values: dict[str, Any] = {}
    if path is not None:
        try:
            values = tomllib.loads(path.read_text(encoding="utf-8"))
        except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
            raise AppError(
                "settings cannot be read", where=path, expected="a TOML file", got=str(error),
                hint="`roomgraph config` prints a valid file",
            ) from error  # fmt: skip
    if only is not None:
        values = _chosen(values, only)
    for name, value in (flags or {}).items():
        if value is not None:
            _set(values, name.split("."), value)
    try:
        return AppSettings.model_validate(values)
    except ValidationError as error:
        first = error.errors()[0]
        name = ".".join(str(part) for part in first["loc"])
        hint = "`roomgraph config` prints all settings with their defaults"
        if first["type"] == "extra_forbidden":
            raise AppError(
                "no such setting", where=path or "command line",
                expected=_likely(first["loc"]), got=name, hint=hint,
            ) from error  # fmt: skip
        raise AppError(
            f"invalid value of setting {name}", where=path or "command line",
            expected=first["msg"].removeprefix("Value error, ").removeprefix("Input should be "),
            got=repr(first.get("input"))[:80], hint=hint,
        ) from error  # fmt: skip


def _likely(wrong: tuple[int | str, ...]) -> str:
    """Return the setting most similar to a wrong name, or all settings of its table."""
    renamed = new_name(".".join(str(part) for part in wrong))
    if renamed is not None:
        return f"{renamed} (its new name)"
    table: Any = AppSettings()
    for part in wrong[:-1]:
        table = getattr(table, str(part))
    names = list(type(table).model_fields)
    meant = get_close_matches(str(wrong[-1]), names, n=1)
    prefix = [str(part) for part in wrong[:-1]]
    return " or ".join(".".join([*prefix, name]) for name in meant or names)


def write_settings(path: Path, settings: AppSettings) -> None:
    """Write resolved settings as TOML."""
    write_text(path, to_toml(settings))


def to_toml(settings: AppSettings) -> str:
    """Return settings as TOML that `load_settings` reads."""
    return tomli_w.dumps(_without_empty(settings.model_dump(mode="json", exclude_none=True)))


def to_commented_toml(settings: AppSettings) -> str:
    """Return settings as TOML with the meaning of each, readable by `load_settings`."""
    lines = ["# Settings of roomgraph. Settings that you leave out keep their defaults.", ""]
    _comment(lines, settings, "")
    return "\n".join(lines) + "\n"


def _comment(lines: list[str], settings: Settings, table: str) -> None:
    """Write a settings model's own values, then its parts as tables."""
    values = _without_empty(settings.model_dump(mode="json", exclude_none=True))
    parts = {n: v for n in values if isinstance(v := getattr(settings, n), Settings)}
    for name, field in type(settings).model_fields.items():
        if name in values and name not in parts:
            value = tomli_w.dumps({name: values[name]}).strip()
            lines.append(f"{value}  # {field.description}" if field.description else value)
    for name, part in parts.items():
        inner = f"{table}.{name}" if table else name
        lines += ["", f"[{inner}]"]
        _comment(lines, part, inner)


def _without_empty(values: dict[str, Any]) -> dict[str, Any]:
    """Return values without tables that hold nothing: parts that have no settings."""
    kept = {n: _without_empty(v) if isinstance(v, dict) else v for n, v in values.items()}
    return {name: value for name, value in kept.items() if value != {}}


def _chosen(values: dict[str, Any], names: Collection[str]) -> dict[str, Any]:
    """Return only the named values and tables, also if given by their old names."""
    chosen: dict[str, Any] = {}
    for name in names:
        found = _value(values, name)
        if found is None:
            found = _value(values, old_name(name))
        if found is not None:
            _set(chosen, name.split("."), found)
    return chosen


def _value(values: dict[str, Any], name: str | None) -> Any:
    """Return the value of a dotted name, None where there is none."""
    found: Any = values
    for part in () if name is None else name.split("."):
        found = found.get(part) if isinstance(found, dict) else None
    return None if name is None else found


def _set(values: dict[str, Any], names: list[str], value: Any) -> None:
    table: Any = values
    for name in names[:-1]:
        table = table.setdefault(name, {})
        if not isinstance(table, dict):
            return  # validation says that a table was expected
    table[names[-1]] = value
