"""From labelled data on disk to a model on disk."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import cast, get_args

from roomgraph.app.console import Terminal
from roomgraph.app.errors import AppError
from roomgraph.app.settings import AppSettings
from roomgraph.datasets.errors import DatasetError
from roomgraph.datasets.readers.registry import guess_layout, open_sequence
from roomgraph.semantics.recognition.examples import Example, folder_examples, sequence_examples
from roomgraph.semantics.recognition.model import PlaceModel
from roomgraph.semantics.recognition.presets import Preset, preset
from roomgraph.semantics.recognition.training import train


def labelled_examples(root: Path) -> list[Example]:
    """Return the labelled images of a sequence with places, or of a folder class/image.

    Raises
    ------
    DatasetError, SemanticsError
        The folder is neither.
    """
    try:
        layout = guess_layout(root) if root.is_dir() else None
    except DatasetError:
        layout = None
    if layout is None:
        return folder_examples(root)
    return sequence_examples(open_sequence(root, layout))


def checked_preset(name: str) -> Preset:
    """Return a preset's name.

    Raises
    ------
    AppError
        There is no preset of that name.
    """
    if name not in get_args(Preset):
        raise AppError(
            "no such preset", where="--preset", expected=" or ".join(get_args(Preset)), got=name
        )
    return cast(Preset, name)


def with_preset(settings: AppSettings, name: str | None) -> AppSettings:
    """Return settings with the training and the features of a named preset, if there is a name.

    Raises
    ------
    AppError
        There is no preset of that name.
    """
    if name is None:
        return settings
    training, features = preset(checked_preset(name))
    slam = settings.slam.model_copy(update={"features": features})
    semantics = settings.semantics.model_copy(update={"training": training})
    return settings.model_copy(update={"slam": slam, "semantics": semantics})


def train_model(data: Sequence[Path], settings: AppSettings, terminal: Terminal) -> PlaceModel:
    """Learn a place model from all `data` together."""
    examples = [example for root in data for example in labelled_examples(root)]
    with terminal.progress("Learning places") as advance:
        return train(
            examples, settings.slam.features, settings.semantics.training, settings.seed,
            lambda done, total: advance(done, total, "images described"),
        )  # fmt: skip
