"""``roomgraph eval``: compare a run with the ground truth."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from app import options


def evaluate(
    run: Annotated[Path, typer.Argument(metavar="RUN", help="Folder of a run.")],
    groundtruth: Annotated[
        Path | None,
        typer.Option("--groundtruth", metavar="TUM", help="True poses; else the sequence's own."),
    ] = None,
    places: Annotated[
        Path | None,
        typer.Option("--places", metavar="CSV", help="True labels; else the sequence's own."),
    ] = None,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="PNG", help="Draw the errors.")
    ] = None,
    overwrite: options.OverwriteOption = False,
    quiet: options.QuietOption = False,
) -> None:
    """Compare a run's trajectory (ATE, RPE) and labels with the ground truth.

    Examples:

      roomgraph eval results/kitchen/latest

      roomgraph eval out --groundtruth truth.txt -o errors.png
    """
    from app.console import Terminal
    from app.evaluation import draw, evaluate_run
    from app.report import against_truth
    from app.run_folder import RunFolder, refuse_existing

    terminal = Terminal(quiet)
    if output is not None:
        refuse_existing(output, overwrite)
    found = evaluate_run(RunFolder(run), groundtruth, places)
    terminal.say(against_truth(found.metrics))
    if output is not None:
        draw(output, found)
        terminal.say(f"Drawn to {output}")
