"""``roomgraph route``: the way from one place of a map to another."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from roomgraph.app.cli import options


def route(
    run: Annotated[Path, typer.Argument(metavar="RUN", help="Folder of a run.")],
    start: Annotated[str, typer.Argument(metavar="FROM", help="Where from.")],
    goal: Annotated[str, typer.Argument(metavar="TO", help="Where to.")],
    as_json: options.JsonOption = False,
) -> None:
    """Say the way from one place to another.

    The shortest one that is known: along the way walked, and across rooms over their free floor.
    Rooms, doors, metres.

    FROM and TO are a place (office1: its middle), a label (kitchen: the nearest of them), or
    coordinates in metres (x,y on the floor of map.yaml, or x,y,z in the trajectory's world).

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
