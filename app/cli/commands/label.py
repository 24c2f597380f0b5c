"""``roomgraph label``: label images with the places they show."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from roomgraph.app.cli import options

if TYPE_CHECKING:
    from roomgraph.app.console import Terminal


def label(
    model: Annotated[Path, typer.Argument(metavar="MODEL", help="Folder of a place model.")],
    data: Annotated[
        Path,
        typer.Argument(
            metavar="DATA", help="Image, folder of images, or sequence. With --set: a run."
        ),
    ],
    output: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--output",
            metavar="PATH",
            help="CSV table item,label,score,truth. With --set: folder of the new model.",
        ),
    ] = None,
    changes: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="PLACE=LABEL",
            help="Correct the label of a place of a run; can be repeated.",
        ),
    ] = None,
    dataset: options.DatasetOption = None,
    camera: options.CameraOption = None,
    config: options.ConfigOption = None,
    overwrite: options.OverwriteOption = False,
    quiet: options.QuietOption = False,
    verbose: options.VerboseOption = False,
) -> None:
    """Label images or a sequence; correct a run.

    Prints the accuracy where the ground truth is known.

    Images are labelled separately. Frames of a sequence are labelled together with their
    neighbours, by a hidden Markov model (or by the paper's majority vote, with
    semantics.labeller.method in --config).

    With --set, DATA is the folder of a run: its graph is corrected, and the labels of neighbouring
    places are inferred again. With -o, a new model also learns the corrected places.

    Examples:

      roomgraph label places photos/test -o labels.csv

      roomgraph label places my_recording

      roomgraph label places out --set office2=library -o places_corrected
    """
    from roomgraph.app.console import Terminal
    from roomgraph.app.learning.labelling import accuracy_table, label_items, write_labels_csv
    from roomgraph.app.settings import load_settings
    from roomgraph.app.storage.run_folder import refuse_existing
    from roomgraph.semantics.recognition.model_files import load_model

    terminal = Terminal(quiet, verbose)
    if changes:
        options.refuse_unused("without --set", config=config, dataset=dataset, camera=camera)
        return _correct(model, data, changes, output, overwrite, terminal)
    if output is not None:
        refuse_existing(output, overwrite)
    vote, places = load_settings(config).semantics.labeller, load_model(model)
    with terminal.progress("Labelling") as advance:
        items = label_items(places, data, advance, vote, dataset, camera)
    if output is not None:
        write_labels_csv(output, items)
        terminal.say(f"{len(items)} labels written to {output}")
    table = accuracy_table(items)
    if table is not None:
        terminal.say(table)
    elif output is None:
        for item in items:
            terminal.say(f"{item.name}  {item.label}  {item.score:.2f}")


def _correct(
    model: Path,
    run: Path,
    texts: list[str],
    output: Path | None,
    overwrite: bool,
    terminal: Terminal,
) -> None:
    from roomgraph.app.learning.correction import (
        corrections_of,
        describe_correction,
        learn_from_run,
        parse_changes,
        write_corrected,
    )
    from roomgraph.app.storage.run_folder import RunFolder
    from roomgraph.semantics.recognition.model_files import load_model, refuse_other, save_model

    changes = parse_changes(texts)
    if output is not None:
        refuse_other(output, overwrite)
    known = load_model(model)
    folder = RunFolder(run)
    corrections = corrections_of(folder, changes)
    if output is not None:
        # The run is changed last: if learning fails, the same command can be given again.
        with terminal.progress("Learning the corrected places") as advance:
            learned = learn_from_run(known, folder, corrections, 0, advance)
        save_model(output, learned, overwrite)
    write_corrected(folder, corrections[-1].graph)
    for place, correction in zip(changes, corrections, strict=True):
        terminal.say(describe_correction(correction, place))
    if output is not None:
        terminal.say(f"Model that knows {', '.join(learned.labels.names[1:])} written to {output}")
