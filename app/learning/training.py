"""From labelled data on disk to a model on disk."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path

from roomgraph.app.console import Terminal
from roomgraph.app.errors import AppError
from roomgraph.app.settings import AppSettings
from roomgraph.datasets.errors import DatasetError
from roomgraph.datasets.readers.registry import guess_layout, open_sequence
from roomgraph.semantics.classifiers.registry import CLASSIFIERS
from roomgraph.semantics.descriptors.registry import DESCRIPTORS
from roomgraph.semantics.recognition.examples import Example, folder_examples, sequence_examples
from roomgraph.semantics.recognition.model import PlaceModel
from roomgraph.semantics.recognition.presets import PRESETS
from roomgraph.semantics.recognition.settings import TrainingSettings
from roomgraph.semantics.recognition.training import train
from roomgraph.slam.features.extraction import FeatureSettings


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


@dataclass(frozen=True, slots=True)
class Recipe:
    """Names of preset, descriptor and classifier; None keeps what the settings say."""

    preset: str | None = None
    descriptor: str | None = None
    classifier: str | None = None

    def applied(self, settings: AppSettings) -> AppSettings:
        """Return settings with the training and feature settings of these names.

        Raises
        ------
        AppError
            There is no preset, descriptor or classifier of that name, or the settings say
            otherwise than by default what a preset says.
        """
        chosen = {"descriptor": self.descriptor, "classifier": self.classifier}
        _check("preset", self.preset, PRESETS)
        _check("descriptor", self.descriptor, DESCRIPTORS)
        _check("classifier", self.classifier, CLASSIFIERS)
        slam, training = settings.slam, settings.semantics.training
        if self.preset is not None:
            if (training, slam.features) != (TrainingSettings(), FeatureSettings()):
                raise AppError(
                    "the settings file says how places are learned, and so does the preset",
                    where=f"--preset {self.preset}", hint="leave one of them out",
                )  # fmt: skip
            preset = PRESETS[self.preset]
            slam, training = slam.model_copy(update={"features": preset.features}), preset.training
        named = {name: value for name, value in chosen.items() if value is not None}
        training = training.model_copy(update=named)
        semantics = settings.semantics.model_copy(update={"training": training})
        return settings.model_copy(update={"slam": slam, "semantics": semantics})


def _check(what: str, name: str | None, known: Collection[str]) -> None:
    if name is not None and name not in known:
        raise AppError(f"no such {what}", where=f"--{what}", expected=" or ".join(known), got=name)


def train_model(data: Sequence[Path], settings: AppSettings, terminal: Terminal) -> PlaceModel:
    """Train a place model on all `data` together."""
    examples = [example for root in data for example in labelled_examples(root)]
    with terminal.progress("Training") as advance:
        return train(
            examples, settings.slam.features, settings.semantics.training, settings.seed,
            lambda done, total: advance(done, total, "images described"),
        )  # fmt: skip
