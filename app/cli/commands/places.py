"""``roomgraph places``: list the places of a map."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from roomgraph.app.cli import options


def places(
    run: Annotated[Path, typer.Argument(metavar="RUN", help="Folder of a run.")],
    as_json: options.JsonOption = False,
) -> None:
    """List the places of a map.

    Prints the label of each place, its probability, area and visits.

    \b
    Examples:
      roomgraph places out
      roomgraph places out --json
    """  # noqa: D301
    import json

    from roomgraph.app.answers.sentences import places_json, places_table
    from roomgraph.app.console import Terminal
    from roomgraph.app.storage.run_folder import RunFolder
    from roomgraph.semantics.graph.files import read_graph_json
    from roomgraph.semantics.graph.visits import summarise

    folder = RunFolder(run)
    graph = read_graph_json(folder.existing(folder.graph_json))
    found = summarise(graph)
    if as_json:
        typer.echo(json.dumps(places_json(found), indent=1))
        return
    rows = folder.read_frames()
    start_s = float(rows[0]["timestamp"]) if rows else 0.0
    terminal = Terminal()
    terminal.say(places_table(found, start_s))
    if not found:
        terminal.say("No places: no frame was tracked.")
