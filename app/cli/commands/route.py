"""``roomgraph route``: find the route from one place of a map to another."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from roomgraph.app.cli import options


def route(
    run: Annotated[Path, typer.Argument(metavar="RUN", help="Folder of a run.")],
    start: Annotated[
        str, typer.Argument(metavar="FROM", help="Start: place, label or coordinates.")
    ],
    goal: Annotated[str, typer.Argument(metavar="TO", help="Goal: place, label or coordinates.")],
    as_json: options.JsonOption = False,
) -> None:
    """Find the route from one place to another.

    Prints the shortest known route, with rooms, doors and metres. It follows the path walked, and
    crosses rooms on their free floor.

    FROM and TO are a place (office1: its middle), a label (kitchen: the nearest one), or
    coordinates in metres (x,y on the floor of map.yaml, or x,y,z in the world frame of the
    trajectory).

    \b
    Examples:
      roomgraph route out office1 kitchen
      roomgraph route out "office 2" 3.5,-1
      roomgraph route out corridor bathroom --json
    """  # noqa: D301
    import json

    from roomgraph.app.answers.sentences import route_json, route_text
    from roomgraph.app.storage.occupancy import read_occupancy
    from roomgraph.app.storage.run_folder import RunFolder
    from roomgraph.semantics.graph.files import read_graph_json
    from roomgraph.semantics.graph.routing import find_route

    folder = RunFolder(run)
    grid = read_occupancy(folder.occupancy) if folder.occupancy.exists() else None
    found = find_route(read_graph_json(folder.existing(folder.graph_json)), start, goal, grid)
    typer.echo(json.dumps(route_json(found), indent=1) if as_json else route_text(found))
