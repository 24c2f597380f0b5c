"""``roomgraph locate``: find where in a map an image was taken."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from roomgraph.app.cli import options


@options.grouped
def locate(
    run: Annotated[Path, typer.Argument(metavar="RUN", help="Folder of a run.")],
    image: Annotated[
        Path, typer.Argument(metavar="IMAGE", help="Image, folder of images, or sequence.")
    ],
    depth: Annotated[
        Path | None, typer.Argument(metavar="DEPTH", help="Depth image, if there is one.")
    ] = None,
    speak: Annotated[
        bool, typer.Option("--speak", help="Also speak the answers, with espeak-ng if installed.")
    ] = False,
    as_json: options.JsonOption = False,
    *,
    opening: options.InputFlags,
) -> None:
    """Find where in a map an image was taken.

    Prints the place, the confidence and the pose. The pose is estimated from the map's features;
    a depth image makes it more reliable but is optional. For a sequence, only changes are printed:
    "you are entering office 2" after 5 frames with the same answer, and "you are in office 2" every
    10 seconds.

    \b
    Examples:
      roomgraph locate out photo.jpg
      roomgraph locate out rgb/12.5.png depth/12.5.png --json
      roomgraph locate out second_walk/ --speak
    """  # noqa: D301
    from roomgraph.app.answers.answers import answer
    from roomgraph.app.answers.locating import Locator
    from roomgraph.app.answers.queries import is_sequence, queries
    from roomgraph.app.storage.run_folder import RunFolder

    folder = RunFolder(run)
    locator = Locator(folder)
    source = opening.of(image)
    answers = (
        (query, locator.locate(query.frame))
        for query in queries(source, depth, folder.read_camera() or locator.camera)
    )
    answer(locator.graph, answers, is_sequence(image), speak, as_json)
