"""``roomgraph label``: say what places images show."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from app import options


def label(
    model: Annotated[Path, typer.Argument(metavar="MODEL", help="Folder from `roomgraph train`.")],
    data: Annotated[
        Path, typer.Argument(metavar="DATA", help="Image, folder of images, or sequence.")
    ],
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", metavar="CSV", help="Table item,label,score,truth."),
    ] = None,
    dataset: options.DatasetOption = None,
    camera: options.CameraOption = None,
    config: options.ConfigOption = None,
    overwrite: options.OverwriteOption = False,
    quiet: options.QuietOption = False,
    verbose: options.VerboseOption = False,
) -> None:
    """Label images or a sequence; tell the accuracy where the truth is known.

    Images are labelled one by one; the frames of a sequence by majority vote of their neighbours.

    Examples:

      roomgraph label places photos/test -o labels.csv

      roomgraph label places my_recording
    """
    from app.config import load_settings
    from app.console import Terminal
    from app.labelling import accuracy_table, label_items, write_labels_csv
    from app.run_folder import refuse_existing
    from semantics.model_io import load_model

    terminal = Terminal(quiet, verbose)
    if output is not None:
        refuse_existing(output, overwrite)
    vote = load_settings(config).semantics.labeller
    with terminal.progress("Labelling") as advance:
        items = label_items(load_model(model), data, advance, vote, dataset, camera)
    if output is not None:
        write_labels_csv(output, items)
        terminal.say(f"{len(items)} labels written to {output}")
    table = accuracy_table(items)
    if table is not None:
        terminal.say(table)
    elif output is None:
        for item in items:
            terminal.say(f"{item.name}  {item.label}  {item.score:.2f}")
