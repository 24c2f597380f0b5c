"""``roomgraph report``: write the report and floor plan of a run again."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from roomgraph.app.cli import options


def report(
    run: Annotated[Path, typer.Argument(metavar="RUN", help="Folder of a run.")],
    quiet: options.QuietOption = False,
) -> None:
    """Write the report and floor plan of a run again.

    Reads the files in its folder; writes report.html, floorplan.svg and floorplan.png.

    Examples:

      roomgraph report out
    """
    from roomgraph.app.console import Terminal
    from roomgraph.app.report.page import write_report
    from roomgraph.app.storage.run_folder import RunFolder

    folder = RunFolder(run)
    folder.existing(folder.graph_json)
    write_report(folder)
    Terminal(quiet).say(f"Report: {folder.report}")
