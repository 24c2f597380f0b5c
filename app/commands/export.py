"""``roomgraph export``: one product of a run in another format."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from app import options


def export(
    run: Annotated[Path, typer.Argument(metavar="RUN", help="Folder of a run.")],
    format: Annotated[
        str,
        typer.Argument(
            metavar="FORMAT", help="tum, kitti, csv; ply, pcd; g2o; json, graphml, dot."
        ),
    ],
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", metavar="FILE", help="Where to write; else into the run."),
    ] = None,
    overwrite: options.OverwriteOption = False,
    quiet: options.QuietOption = False,
) -> None:
    """Write one product of a run in another format.

    Trajectory: tum, kitti, csv. Map: ply, pcd. Pose graph: g2o. Topological graph: json, graphml,
    dot.

    Examples:

      roomgraph export out kitti -o poses.txt

      roomgraph export out dot -o rooms.dot
    """
    from app.console import Terminal
    from app.exporting import export_run
    from app.run_folder import RunFolder

    path = export_run(RunFolder(run), format, output, overwrite)
    Terminal(quiet).say(f"Written to {path}")
