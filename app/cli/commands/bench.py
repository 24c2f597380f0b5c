"""``roomgraph bench``: measure time, memory and accuracy of mapping."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from roomgraph.app.cli import options

if TYPE_CHECKING:
    from roomgraph.app.bench.worker import BenchJob
    from roomgraph.app.console import Terminal


@options.grouped
def bench(
    sequences: Annotated[
        list[Path], typer.Argument(metavar="SEQUENCE", help="Folders of RGB-D sequences.")
    ],
    repeat: Annotated[
        int, typer.Option("--repeat", metavar="N", min=1, help="Number of runs of each sequence.")
    ] = 3,
    laps: Annotated[
        int,
        typer.Option(
            "--laps",
            metavar="N",
            min=0,
            help="Play each sequence forward and backward N times.",
            show_default="once, forward",
        ),
    ] = 0,
    as_json: options.JsonOption = False,
    output: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--output",
            metavar="DIR",
            help="Write bench.json, with the time of each frame, and a plot of each sequence.",
        ),
    ] = None,
    model: Annotated[
        Path | None,
        typer.Option(
            "--model", metavar="DIR", help="Place model; runs each sequence without and with it."
        ),
    ] = None,
    *,
    opening: options.InputFlags,
    tuning: options.SettingFlags,
    overwrite: options.OverwriteOption = False,
    quiet: options.QuietOption = False,
) -> None:
    """Measure time, memory and accuracy of mapping.

    Each run is a separate process, without viewer and recording. Reports medians over the repeats,
    whether frames take longer at the end of a run than at its beginning, and whether all repeats
    give exactly the same trajectory.

    Examples:

      roomgraph bench rgbd_dataset_freiburg1_room

      roomgraph bench kitchen office --repeat 5 --json > bench.json

      roomgraph bench kitchen --laps 3 -o flat

      roomgraph bench kitchen --model places
    """
    from roomgraph.app.bench.worker import BenchJob
    from roomgraph.app.console import Terminal
    from roomgraph.app.storage.run_folder import clear_output

    terminal = Terminal(quiet or as_json)
    settings = tuning.load()
    if output is not None:
        clear_output(output, overwrite, ("bench.json",))
    jobs = [
        BenchJob(opening.of(path), settings, places, laps)
        for path in sequences
        for places in ((None, model) if model is not None else (None,))
    ]
    found = _measure(jobs, repeat, output, terminal)
    if as_json:
        typer.echo(found)


def _measure(jobs: list[BenchJob], repeat: int, output: Path | None, terminal: Terminal) -> str:
    """Run the jobs; show and write the results, and return them as JSON."""
    from json import dumps

    from roomgraph.app.bench.bench import frame_times, labelling_cost, report, run_all, summarise
    from roomgraph.app.bench.report import draw, table
    from roomgraph.datasets.files import write_text

    with terminal.progress("Measuring") as advance:
        runs = run_all(jobs, repeat, advance)
    summaries = [summarise(repeats, job) for repeats, job in zip(runs, jobs, strict=True)]
    found = report(summaries)
    terminal.say(table(summaries, labelling_cost(summaries)))
    if output is not None:
        output.mkdir(parents=True)
        whole = found | {"frame_times": [frame_times(repeats) for repeats in runs]}
        write_text(output / "bench.json", dumps(whole, indent=1) + "\n")
        for number, repeats in enumerate(runs):
            draw(output / f"{number + 1}-{repeats[0].name}.png", repeats)
        terminal.say(f"Written to {output}")
    return dumps(found, indent=1)
