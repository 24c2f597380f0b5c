"""``roomgraph export``: convert an output of a run to another format."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from roomgraph.app.cli import options


def _list(wanted: bool) -> None:
    if not wanted:
        return
    from roomgraph.app.export.registry import EXPORTERS

    width = max(map(len, EXPORTERS))
    for name, exporter in EXPORTERS.items():
        typer.echo(f"{name:<{width}}  {exporter.kind}: {exporter.meaning}")
    raise typer.Exit


def export(
    run: Annotated[Path, typer.Argument(metavar="RUN", help="Folder of a run.")],
    format: Annotated[str, typer.Argument(metavar="FORMAT", help="A format from --list.")],
    output: Annotated[
        Path | None,
        typer.Option(
            "-o", "--output", metavar="FILE", help="Output file. Default: in the run's folder."
        ),
    ] = None,
    list_formats: Annotated[
        bool,
        typer.Option("--list", callback=_list, is_eager=True, help="Print all formats and exit."),
    ] = False,
    overwrite: options.OverwriteOption = False,
    quiet: options.QuietOption = False,
) -> None:
    """Convert an output of a run to another format.

    Exports the trajectory, pose graph, point cloud, mesh, graph or occupancy grid; --list prints
    the formats of each.

    \b
    Examples:
      roomgraph export out kitti -o poses.txt
      roomgraph export out las -o floor.las
      roomgraph export out glb -o floor.glb
      roomgraph export out hydra -o scene_graph.json
      roomgraph export out nav2 -o floor.yaml
      roomgraph export --list
    """  # noqa: D301
    from roomgraph.app.console import Terminal
    from roomgraph.app.export.registry import export_run
    from roomgraph.app.storage.run_folder import RunFolder

    terminal = Terminal(quiet)
    files, notes = export_run(RunFolder(run), format, output, overwrite)
    for note in notes:
        terminal.say(note, dim=True)
    terminal.say(f"Written to {', '.join(map(str, files))}")
