"""``roomgraph train``: train a place model."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from roomgraph.app.cli import options


@options.grouped
def train(
    data: Annotated[
        list[Path],
        typer.Argument(
            metavar="DATA...", help="Folders class/image, or sequences with places.csv."
        ),
    ],
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="MODEL", help="Folder of the model.")
    ],
    recipe: options.RecipeFlags,
    config: options.ConfigOption = None,
    seed: options.SeedOption = None,
    overwrite: options.OverwriteOption = False,
    quiet: options.QuietOption = False,
    verbose: options.VerboseOption = False,
) -> None:
    """Train a place model on labelled images or sequences.

    A place model is an image descriptor and a classifier. Each DATA is a folder with a subfolder
    of images for each class, or an RGB-D sequence with a places.csv (timestamp,label).

    Examples:

      roomgraph train photos/ -o places

      roomgraph train day_walk night_walk -o places

      roomgraph train photos/ -o as_published --preset paper

      roomgraph train photos/ -o by_words --descriptor words
    """
    from roomgraph.app.console import Terminal
    from roomgraph.app.learning.training import train_model
    from roomgraph.app.settings import load_settings
    from roomgraph.semantics.recognition.model_files import refuse_other, save_model

    terminal = Terminal(quiet, verbose)
    settings = recipe.recipe().applied(load_settings(config, {"seed": seed}))
    refuse_other(output, overwrite)
    with terminal.logging():
        model = train_model(data, settings, terminal)
    save_model(output, model, overwrite)
    images = ", ".join(f"{name} {count}" for name, count in model.training["images"].items())
    terminal.say(f"Learned {len(model.labels) - 1} places from: {images}")
    terminal.say(
        f"Accuracy on held-out images: {model.training['cross_validated_accuracy']:.1%} "
        f"(chance: {1 / (len(model.labels) - 1):.1%}). "
        f"Model written to {output}"
    )
