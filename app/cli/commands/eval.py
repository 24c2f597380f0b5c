"""``roomgraph eval``: compare a run with the ground truth."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from roomgraph.app.cli import options

if TYPE_CHECKING:
    from roomgraph.app.console import Terminal
    from roomgraph.app.learning.training import Recipe
    from roomgraph.app.settings import AppSettings


@options.grouped
def evaluate(
    recipe: options.RecipeFlags,
    run: Annotated[
        Path | None,
        typer.Argument(metavar="RUN", help="Folder of a run; leave out with --protocol."),
    ] = None,
    groundtruth: Annotated[
        Path | None,
        typer.Option(
            "--groundtruth", metavar="TUM", help="Ground-truth poses. Default: the sequence's own."
        ),
    ] = None,
    places: Annotated[
        Path | None,
        typer.Option(
            "--places", metavar="CSV", help="Ground-truth labels. Default: the sequence's own."
        ),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--output",
            metavar="PATH",
            help="For a run: plot of the errors (PNG). For an experiment: output folder.",
        ),
    ] = None,
    protocol: Annotated[
        str | None,
        typer.Option(
            "--protocol",
            metavar="NAME",
            help="Experiment of the paper: recognition, light, building, route or vocabulary.",
        ),
    ] = None,
    data: Annotated[
        list[Path] | None,
        typer.Option(
            "--data",
            metavar="DIR",
            help="Data of the experiment; can be repeated. Default: rendered buildings.",
        ),
    ] = None,
    config: options.ConfigOption = None,
    seed: options.SeedOption = None,
    overwrite: options.OverwriteOption = False,
    quiet: options.QuietOption = False,
) -> None:
    """Compare a run with the ground truth; run experiments.

    Evaluates the trajectory (ATE, RPE) and the labels of a run. An experiment uses rendered
    buildings (stored in a cache) or --data: folders class/image, train and test folders of those,
    or sequences with places.csv. It writes NAME.json, NAME.md and NAME.png.

    Examples:

      roomgraph eval results/kitchen/latest

      roomgraph eval out --groundtruth truth.txt -o errors.png

      roomgraph eval --protocol building -o tables

      roomgraph eval --protocol recognition --data photos --preset paper

      roomgraph eval --protocol building --descriptor words
    """
    from roomgraph.app.console import Terminal
    from roomgraph.app.errors import AppError
    from roomgraph.app.report.figures import against_truth
    from roomgraph.app.run.evaluation import draw, evaluate_run
    from roomgraph.app.settings import load_settings
    from roomgraph.app.storage.run_folder import RunFolder, refuse_existing

    terminal = Terminal(quiet)
    if protocol is not None or run is None:
        if protocol is None or run is not None:
            raise AppError("nothing to evaluate", expected="either RUN or --protocol NAME")
        options.refuse_unused("without --protocol", groundtruth=groundtruth, places=places)
        settings = load_settings(config, {"seed": seed})
        outcome = _Outcome(output or Path("results") / "protocols", protocol, overwrite)
        return _experiment(outcome, recipe.recipe(), settings, data or [], terminal)
    options.refuse_unused(
        "with --protocol", data=data or None, config=config, seed=seed, **asdict(recipe)
    )
    if output is not None:
        refuse_existing(output, overwrite)
    found = evaluate_run(RunFolder(run), groundtruth, places)
    terminal.say(against_truth(found.metrics))
    if output is not None:
        draw(output, found)
        terminal.say(f"Plot written to {output}")


@dataclass(frozen=True, slots=True)
class _Outcome:
    """Where the tables and the plot of an experiment are written."""

    directory: Path
    protocol: str
    overwrite: bool

    def check(self) -> None:
        """Raise if they exist and may not be overwritten."""
        from roomgraph.app.storage.run_folder import refuse_existing

        table = self.directory / f"{self.protocol}.json"
        if table.exists():
            refuse_existing(table, self.overwrite)


def _experiment(
    outcome: _Outcome, recipe: Recipe, settings: AppSettings, data: list[Path], terminal: Terminal
) -> None:
    from threadpoolctl import threadpool_limits

    from roomgraph.app.experiments.protocols import run_protocol
    from roomgraph.app.experiments.report import markdown, write_report
    from roomgraph.app.experiments.vocabulary import (
        run_vocabulary,
        vocabulary_markdown,
        write_vocabulary,
    )

    outcome.check()
    with threadpool_limits(1, user_api="blas"):
        if outcome.protocol == "vocabulary":
            options.refuse_unused("with the other experiments", **asdict(recipe))
            content = write_vocabulary(outcome.directory, run_vocabulary(data, terminal), data)
            terminal.say(vocabulary_markdown(content))
        else:
            report = run_protocol(outcome.protocol, recipe, settings, data, terminal)
            terminal.say(markdown(write_report(outcome.directory, report)))
    name = outcome.protocol
    terminal.say(f"Written to {outcome.directory}: {name}.json, {name}.md, {name}.png")
