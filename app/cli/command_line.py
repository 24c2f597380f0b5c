"""The ``roomgraph`` command and its subcommands."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Annotated, Any

import typer

from roomgraph.app.cli.commands.bench import bench
from roomgraph.app.cli.commands.config import config
from roomgraph.app.cli.commands.demo import demo
from roomgraph.app.cli.commands.eval import evaluate
from roomgraph.app.cli.commands.export import export
from roomgraph.app.cli.commands.label import label
from roomgraph.app.cli.commands.locate import locate
from roomgraph.app.cli.commands.places import places
from roomgraph.app.cli.commands.report import report
from roomgraph.app.cli.commands.route import route
from roomgraph.app.cli.commands.run import run
from roomgraph.app.cli.commands.synth import synth
from roomgraph.app.cli.commands.train import train
from roomgraph.app.cli.commands.view import view
from roomgraph.datasets.errors import RoomgraphError

EXIT_FAILURE, EXIT_INTERRUPTED = 1, 130

cli = typer.Typer(
    name="roomgraph",
    help="Turn an RGB-D sequence into a labelled 3-D map and a graph of its rooms.",
    epilog="Start with: roomgraph demo",
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode=None,
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


def _guarded(command: Callable[..., None]) -> Callable[..., None]:
    """Turn an expected failure into one line on standard error and exit status 1."""

    @wraps(command)
    def run_command(*args: Any, **kwargs: Any) -> None:
        try:
            command(*args, **kwargs)
        except RoomgraphError as error:
            typer.echo(f"roomgraph: {error}", err=True)
            raise typer.Exit(EXIT_FAILURE) from error
        except OSError as error:
            where = f": {error.filename}" if error.filename else ""
            typer.echo(f"roomgraph: {error.strerror or error}{where}", err=True)
            raise typer.Exit(EXIT_FAILURE) from error
        except KeyboardInterrupt as error:
            typer.echo("roomgraph: interrupted; what was done so far is on disk", err=True)
            raise typer.Exit(EXIT_INTERRUPTED) from error

    return run_command


for _command in (
    demo,
    run,
    train,
    label,
    view,
    report,
    export,
    places,
    route,
    locate,
    synth,
    bench,
    config,
):
    # A negative coordinate is not a flag.
    context = {"ignore_unknown_options": True} if _command is route else None
    cli.command(context_settings=context)(_guarded(_command))
cli.command("eval")(_guarded(evaluate))
