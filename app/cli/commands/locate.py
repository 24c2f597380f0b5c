"""``roomgraph locate``: where in a map an image was taken."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from roomgraph.app.cli import options


@options.grouped
def locate(
    run: Annotated[Path, typer.Argument(metavar="RUN", help="Folder of a run.")],
    image: Annotated[
        Path, typer.Argument(metavar="IMAGE", help="An image, a folder of them, or a sequence.")
    ],
    depth: Annotated[
        Path | None, typer.Argument(metavar="DEPTH", help="Depth of the image, if known.")
    ] = None,
    speak: Annotated[
        bool, typer.Option("--speak", help="Say it aloud too, with espeak-ng where it is there.")
    ] = False,
    as_json: options.JsonOption = False,
    *,
    opening: options.InputFlags,
) -> None:
    """Say where in a map an image was taken.

    In which place, how sure that is, and the pose. The pose is measured against the map's features;
    the depth of the image makes it surer but need not be known. Of a sequence only what changes is
    said: "you are entering office 2" once the answer has held for 5 frames, "you are in office 2"
    every 10 seconds.

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
