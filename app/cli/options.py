"""The flags that several commands share."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass, fields, is_dataclass
from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, get_type_hints

import typer

if TYPE_CHECKING:
    from roomgraph.app.learning.training import Recipe
    from roomgraph.app.settings import AppSettings
    from roomgraph.app.storage.input import InputOptions


def _listed(layout: str | None) -> str | None:
    """Print all layouts and exit if the value is `list`."""
    if layout == "list":
        from roomgraph.datasets.readers.registry import READERS

        for name, reader in READERS.items():
            typer.echo(f"{name:10} {reader.files}")
        raise typer.Exit
    return layout


SequenceArgument = Annotated[
    Path, typer.Argument(metavar="SEQUENCE", help="Folder of an RGB-D sequence.")
]
OutputOption = Annotated[
    Path | None,
    typer.Option(
        "-o",
        "--output",
        metavar="DIR",
        help="Output folder. Default: results/NAME/TIME, with a link `latest`.",
    ),
]
OverwriteOption = Annotated[bool, typer.Option("--overwrite", help="Replace existing output.")]
DatasetOption = Annotated[
    str | None,
    typer.Option(
        "--dataset",
        metavar="LAYOUT",
        callback=_listed,
        is_eager=True,
        help="Layout of the dataset; detected if left out. `list` prints all layouts.",
    ),
]
CameraOption = Annotated[
    Path | None,
    typer.Option("--camera", metavar="JSON", help="Camera file that replaces the sequence's own."),
]
DepthScaleOption = Annotated[
    float | None,
    typer.Option("--depth-scale", metavar="N", min=1e-3, help="Raw depth units per metre."),
]
ModelOption = Annotated[
    Path | None,
    typer.Option("--model", metavar="DIR", help="Folder of a place model."),
]
ConfigOption = Annotated[
    Path | None,
    typer.Option(
        "--config", metavar="TOML", help="Settings file, in the format of `roomgraph config`."
    ),
]
StartOption = Annotated[
    int, typer.Option("--start", metavar="N", min=0, help="Number of the first frame.")
]
FramesOption = Annotated[
    int | None,
    typer.Option(
        "--frames", metavar="N", min=1, help="Maximum number of frames.", show_default="all"
    ),
]
StrideOption = Annotated[
    int, typer.Option("--stride", metavar="N", min=1, help="Use every N-th frame.")
]
MaxDepthOption = Annotated[
    float | None,
    typer.Option("--max-depth", metavar="M", min=0.1, help="Ignore depth beyond M metres."),
]
VisualizeOption = Annotated[
    bool, typer.Option("-v", "--visualize", help="Show the run live in Rerun.")
]
SaveRrdOption = Annotated[
    bool, typer.Option("--save-rrd/--no-rrd", help="Write recording.rrd for Rerun.")
]
ReportOption = Annotated[
    bool, typer.Option("--report/--no-report", help="Write report.html and the floor plan.")
]
PresetOption = Annotated[
    str | None,
    typer.Option("--preset", metavar="NAME", help="best or paper (as published). [default: best]"),
]
DescriptorOption = Annotated[
    str | None,
    typer.Option("--descriptor", metavar="NAME", help="Image descriptor; see `roomgraph config`."),
]
ClassifierOption = Annotated[
    str | None,
    typer.Option("--classifier", metavar="NAME", help="Classifier; see `roomgraph config`."),
]
SeedOption = Annotated[
    int | None,
    typer.Option(
        "--seed", metavar="N", min=0, help="Seed of all random choices.", show_default="0"
    ),
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print only JSON on standard output.")]
QuietOption = Annotated[bool, typer.Option("--quiet", help="Print only errors.")]
VerboseOption = Annotated[bool, typer.Option("--verbose", help="Print log messages.")]


@dataclass(frozen=True, slots=True)
class InputFlags:
    """How a sequence is opened."""

    dataset: DatasetOption = None
    camera: CameraOption = None
    depth_scale: DepthScaleOption = None
    start: StartOption = 0
    frames: FramesOption = None
    stride: StrideOption = 1

    def of(self, sequence: Path) -> InputOptions:
        """Return the options to open a sequence with."""
        from roomgraph.app.storage.input import InputOptions

        return InputOptions(
            sequence=sequence, dataset=self.dataset, camera=self.camera,
            depth_scale=self.depth_scale, start=self.start, frames=self.frames, stride=self.stride,
        )  # fmt: skip


@dataclass(frozen=True, slots=True)
class SettingFlags:
    """Where the settings come from."""

    config: ConfigOption = None
    max_depth: MaxDepthOption = None
    seed: SeedOption = None

    def load(self) -> AppSettings:
        """Return the settings of the file; flags take precedence."""
        from roomgraph.app.settings import load_settings

        return load_settings(self.config, {"seed": self.seed, "slam.max_depth_m": self.max_depth})


def refuse_unused(where: str, **flags: object) -> None:
    """Raise if options were given that have no effect in this use of a command.

    Parameters
    ----------
    where : str
        When they are used: ``with --protocol``.
    flags : object
        Values by name; None if not given.
    """
    from roomgraph.app.errors import AppError

    given = [f"--{name.replace('_', '-')}" for name, value in flags.items() if value is not None]
    if given:
        raise AppError(
            "option has no effect here", where=", ".join(given),
            hint=f"it is used only {where}; leave it out",
        )  # fmt: skip


@dataclass(frozen=True, slots=True)
class RecipeFlags:
    """Preset, descriptor and classifier of a place model."""

    preset: PresetOption = None
    descriptor: DescriptorOption = None
    classifier: ClassifierOption = None

    def recipe(self) -> Recipe:
        """Return the names given as flags."""
        from roomgraph.app.learning.training import Recipe

        return Recipe(self.preset, self.descriptor, self.classifier)


def grouped(command: Callable[..., None]) -> Callable[..., None]:
    """Turn the fields of a command's dataclass parameters into flags of the command."""
    own = inspect.signature(command).parameters.values()
    hints = get_type_hints(command, include_extras=True)
    groups = {p.name: hints[p.name] for p in own if is_dataclass(hints[p.name])}
    flags = []
    for parameter in own:
        if parameter.name in groups:
            flags += _flags_of(groups[parameter.name])
        else:
            flags.append(
                parameter.replace(annotation=hints[parameter.name], kind=parameter.KEYWORD_ONLY)
            )

    @wraps(command)
    def run_command(**values: Any) -> None:
        for name, group in groups.items():
            given = {field.name: values.pop(field.name) for field in fields(group)}
            values[name] = group(**given)
        command(**values)

    run_command.__annotations__ = {flag.name: flag.annotation for flag in flags}
    run_command.__dict__["__signature__"] = inspect.Signature(flags)
    return run_command


def _flags_of(group: Any) -> list[inspect.Parameter]:
    hints = get_type_hints(group, include_extras=True)
    return [
        inspect.Parameter(
            field.name, inspect.Parameter.KEYWORD_ONLY, default=field.default,
            annotation=hints[field.name],
        )
        for field in fields(group)
    ]  # fmt: skip
