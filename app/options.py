"""The flags that several commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

SequenceArgument = Annotated[
    Path, typer.Argument(metavar="SEQUENCE", help="Folder of an RGB-D sequence.")
]
OutputOption = Annotated[
    Path | None,
    typer.Option(
        "-o",
        "--output",
        metavar="DIR",
        help="Where to write; else results/NAME/TIME, with a link `latest`.",
    ),
]
OverwriteOption = Annotated[
    bool, typer.Option("--overwrite", help="Replace an output that is there already.")
]
DatasetOption = Annotated[
    str | None,
    typer.Option(
        "--dataset", metavar="LAYOUT", help="tum, 7scenes or folder; guessed if left out."
    ),
]
CameraOption = Annotated[
    Path | None,
    typer.Option("--camera", metavar="JSON", help="Camera file in place of the sequence's own."),
]
DepthScaleOption = Annotated[
    float | None,
    typer.Option("--depth-scale", metavar="N", min=1e-3, help="Raw depth units a metre."),
]
ModelOption = Annotated[
    Path | None,
    typer.Option("--model", metavar="DIR", help="Place model from `roomgraph train`."),
]
ConfigOption = Annotated[
    Path | None,
    typer.Option("--config", metavar="TOML", help="Settings, as `roomgraph config` prints them."),
]
StartOption = Annotated[int, typer.Option("--start", metavar="N", min=0, help="First frame.")]
FramesOption = Annotated[
    int | None,
    typer.Option("--frames", metavar="N", min=1, help="Frames at most.", show_default="all"),
]
StrideOption = Annotated[
    int, typer.Option("--stride", metavar="N", min=1, help="Every n-th frame.")
]
MaxDepthOption = Annotated[
    float | None,
    typer.Option("--max-depth", metavar="M", min=0.1, help="Ignore readings beyond, metres."),
]
VisualizeOption = Annotated[
    bool, typer.Option("-v", "--visualize", help="Watch the run live in Rerun.")
]
SaveRrdOption = Annotated[
    bool, typer.Option("--save-rrd/--no-rrd", help="Write recording.rrd for Rerun.")
]
ReportOption = Annotated[
    bool, typer.Option("--report/--no-report", help="Write report.html and the floor plan.")
]
SeedOption = Annotated[
    int | None,
    typer.Option("--seed", metavar="N", min=0, help="Of all random choices.", show_default="0"),
]
JsonOption = Annotated[
    bool, typer.Option("--json", help="Print JSON, and nothing else, on standard output.")
]
QuietOption = Annotated[bool, typer.Option("--quiet", help="Say nothing but errors.")]
VerboseOption = Annotated[bool, typer.Option("--verbose", help="Say what is going on inside.")]
