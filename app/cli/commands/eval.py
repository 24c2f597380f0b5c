"""``roomgraph eval``: compare a run with the ground truth."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from roomgraph.app.cli import options

if TYPE_CHECKING:
    from roomgraph.app.console import Terminal


def evaluate(
    run: Annotated[
        Path | None, typer.Argument(metavar="RUN", help="Folder of a run; none with --protocol.")
    ] = None,
    groundtruth: Annotated[
        Path | None,
        typer.Option("--groundtruth", metavar="TUM", help="True poses; else the sequence's own."),
    ] = None,
    places: Annotated[
        Path | None,
        typer.Option("--places", metavar="CSV", help="True labels; else the sequence's own."),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--output",
            metavar="PATH",
            help="Draw a run's errors (PNG); the folder of an experiment's tables and picture.",
        ),
    ] = None,
    protocol: Annotated[
        str | None,
        typer.Option(
            "--protocol",
            metavar="NAME",
            help="An experiment of the paper: recognition, light, building, route or vocabulary.",
        ),
    ] = None,
    data: Annotated[
        list[Path] | None,
        typer.Option(
            "--data",
            metavar="DIR",
            help="What to experiment on, once for each folder; else rendered buildings.",
        ),
    ] = None,
    preset: Annotated[
        str, typer.Option("--preset", metavar="NAME", help="best, or paper: as published.")
    ] = "best",
    seed: options.SeedOption = None,
    overwrite: options.OverwriteOption = False,
    quiet: options.QuietOption = False,
) -> None:
    """Compare a run with the truth; run experiments.

    Of a run: its trajectory (ATE, RPE) and labels. An experiment runs on rendered buildings (kept
    in a cache) or on --data: folders class/image, train and test folders of those, or sequences
    with places.csv. It writes NAME.json, NAME.md and NAME.png.

    Examples:

      roomgraph eval results/kitchen/latest

      roomgraph eval out --groundtruth truth.txt -o errors.png

      roomgraph eval --protocol building -o tables

      roomgraph eval --protocol recognition --data photos --preset paper
    """
    from roomgraph.app.console import Terminal
    from roomgraph.app.report.figures import against_truth
    from roomgraph.app.run.evaluation import draw, evaluate_run
    from roomgraph.app.storage.run_folder import RunFolder, refuse_existing

    terminal = Terminal(quiet)
    if protocol is not None or run is None:
        return _experiment(
            protocol, run, data or [], terminal, output=output, preset=preset, seed=seed or 0,
            overwrite=overwrite,
        )  # fmt: skip
    if output is not None:
        refuse_existing(output, overwrite)
    found = evaluate_run(RunFolder(run), groundtruth, places)
    terminal.say(against_truth(found.metrics))
    if output is not None:
        draw(output, found)
        terminal.say(f"Drawn to {output}")


def _experiment(
    protocol: str | None,
    run: Path | None,
    data: list[Path],
    terminal: Terminal,
    *,
    output: Path | None,
    preset: str,
    seed: int,
    overwrite: bool,
) -> None:
    from threadpoolctl import threadpool_limits

    from roomgraph.app.errors import AppError
    from roomgraph.app.experiments.protocols import run_protocol
    from roomgraph.app.experiments.report import markdown, write_report
    from roomgraph.app.experiments.vocabulary import (
        run_vocabulary,
        vocabulary_markdown,
        write_vocabulary,
    )
    from roomgraph.app.learning.training import checked_preset
    from roomgraph.app.storage.run_folder import refuse_existing

    if protocol is None or run is not None:
        raise AppError("nothing to evaluate", expected="either RUN or --protocol NAME")
    output = output or Path("results") / "protocols"
    if (output / f"{protocol}.json").exists():
        refuse_existing(output / f"{protocol}.json", overwrite)
    with threadpool_limits(1, user_api="blas"):
        if protocol == "vocabulary":
            content = write_vocabulary(output, run_vocabulary(data, terminal), data)
            terminal.say(vocabulary_markdown(content))
        else:
            report = run_protocol(protocol, checked_preset(preset), data, seed, terminal)
            terminal.say(markdown(write_report(output, report)))
    terminal.say(f"Written to {output}: {protocol}.json, {protocol}.md, {protocol}.png")
