"""The ``roomgraph`` command."""

from __future__ import annotations

import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Annotated

import typer

from app.commands.config import config
from app.commands.demo import demo
from app.commands.eval import evaluate
from app.commands.export import export
from app.commands.label import label
from app.commands.run import run
from app.commands.synth import synth
from app.commands.train import train
from app.commands.view import view
from datasets.errors import RoomgraphError

EXIT_FAILURE, EXIT_INTERRUPTED = 1, 130

cli = typer.Typer(
    name="roomgraph",
    help="Turn an RGB-D sequence into a labelled 3-D map and a graph of its rooms.",
    epilog="Start with: roomgraph demo",
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode="markdown",
    context_settings={"help_option_names": ["-h", "--help"]},
    pretty_exceptions_enable=False,
)


def _version(wanted: bool) -> None:
    if wanted:
        from importlib.metadata import version

        typer.echo(f"roomgraph {version('roomgraph')}")
        raise typer.Exit


@cli.callback()
def _root(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    """Turn an RGB-D sequence into a labelled 3-D map and a graph of its rooms."""


for _command in (demo, run, train, label, view, export, synth, config):
    cli.command()(_command)
cli.command("eval")(evaluate)


def main() -> None:
    """Run the command; an expected failure is one line on standard error and exit status 1."""
    try:
        _check_datasets_is_ours()
        cli(standalone_mode=True)
    except RoomgraphError as error:
        sys.stderr.write(f"roomgraph: {error}\n")
        sys.exit(EXIT_FAILURE)
    except KeyboardInterrupt:
        sys.stderr.write("roomgraph: interrupted; what was done so far is on disk\n")
        sys.exit(EXIT_INTERRUPTED)


def _check_datasets_is_ours() -> None:
    """Raise if another package called `datasets` would be imported in place of ours."""
    found = find_spec("datasets")
    ours = Path(__file__).resolve().parent.parent / "datasets"
    if found is None or found.origin is None or Path(found.origin).resolve().parent != ours:
        raise RoomgraphError(
            "another package named 'datasets' is in the way",
            where=found.origin if found else None, expected=str(ours),
            hint="install roomgraph into an environment of its own",
        )  # fmt: skip
