from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
import pytest

from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.frame import Frame
from roomgraph.datasets.places import PlaceTruth
from roomgraph.semantics.errors import SemanticsError
from roomgraph.semantics.recognition.examples import folder_examples, sequence_examples, thin_out
from roomgraph.semantics.recognition.settings import TrainingSettings
from roomgraph.semantics.recognition.training import train
from roomgraph.slam.features.extraction import FeatureSettings

pytestmark = pytest.mark.slow

FEATURES = FeatureSettings(max_features=200)


def settings(**words) -> TrainingSettings:
    """Fisher vectors, their views compared by few words."""
    fisher = {"signature": {"n_words": 20, "n_epochs": 2} | words}
    return TrainingSettings.model_validate({"descriptors": {"fisher": fisher}})


SETTINGS = settings()


def image(kind: str, seed: int) -> np.ndarray:
    """Discs, boxes or strokes on grey."""
    rng = np.random.default_rng(seed)
    canvas = np.full((120, 160, 3), 90, np.uint8)
    for x, y, size, tone in rng.integers((5, 5, 4, 120), (155, 115, 14, 255), (25, 4)).tolist():
        if kind == "discs":
            cv2.circle(canvas, (x, y), size, (tone, tone, tone), -1)
        elif kind == "boxes":
            cv2.rectangle(canvas, (x, y), (x + size, y + size), (tone, tone, tone), -1)
        else:
            cv2.line(canvas, (x, y), (x + 3 * size, y + size), (tone, tone, tone), 2)
    return canvas


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for kind in ("discs", "boxes", "strokes"):
        (tmp_path / "photos" / kind).mkdir(parents=True)
        for i in range(12):
            cv2.imwrite(str(tmp_path / "photos" / kind / f"{i:02}.png"), image(kind, i))
    return tmp_path / "photos"


@dataclass
class Film:
    """Six visits of five frames."""

    name: str = "film"
    root: Path = Path("film")
    places: PlaceTruth | None = None

    def __post_init__(self):
        kinds = [k for k in ("discs", "boxes") * 3 for _ in range(5)]
        self.stamps_s = np.arange(30) / 10
        self.kinds = kinds
        self.places = PlaceTruth(self.stamps_s[:28], tuple(kinds[:28]), ("",) * 28)

    def __len__(self):
        return 30

    def __getitem__(self, index):
        colour = image(self.kinds[index], index)
        depth = np.ones((120, 160), np.float32)
        return Frame(index, index / 10, colour, depth, Intrinsics(160, 120, 150, 150, 80, 60))


def test_learns_from_folders(folder):
    calls = []
    model = train(
        folder_examples(folder), FEATURES, SETTINGS, seed=1, progress=lambda *n: calls.append(n)
    )
    assert model.labels.names == ("unknown", "boxes", "discs", "strokes")
    assert model.training["images"] == {"boxes": 12, "discs": 12, "strokes": 12}
    assert model.training["cross_validated_accuracy"] > 0.7
    assert calls == [(i, 36) for i in range(1, 37)]
    kinds = [k for k in ("discs", "boxes", "strokes") for _ in range(10)]
    found = [model.predict(image(kind, 100 + i)).label for i, kind in enumerate(kinds)]
    assert np.mean(np.array(found) == kinds) > 0.7


def test_same_seed_same_model(folder):
    a, b = (train(folder_examples(folder), FEATURES, SETTINGS, seed=5) for _ in range(2))
    for ours, theirs in ((a.descriptor, b.descriptor), (a.classifier, b.classifier)):
        assert ours.arrays().keys() == theirs.arrays().keys()
        for name, array in ours.arrays().items():
            np.testing.assert_array_equal(array, theirs.arrays()[name])


def test_learns_from_sequences():
    examples = sequence_examples(Film())
    assert len(examples) == 28
    assert len({e.group for e in examples}) == 6
    model = train(examples, FEATURES, SETTINGS)
    assert model.labels.names == ("unknown", "boxes", "discs")


def test_learns_from_binary_descriptors(folder):
    model = train(folder_examples(folder), FeatureSettings(detector="orb"), SETTINGS)
    assert model.descriptor.arrays()["signature_prototypes"].shape == (20, 256)


def test_unreadable_and_empty_images_are_left_out(folder, caplog):
    (folder / "discs" / "broken.png").write_bytes(b"not an image")
    cv2.imwrite(str(folder / "boxes" / "blank.png"), np.full((120, 160), 90, np.uint8))
    model = train(folder_examples(folder), FEATURES, SETTINGS)
    assert (model.training["unreadable"], model.training["featureless"]) == (1, 1)
    assert "broken.png" in caplog.text


def test_thinning_is_even_and_by_label(folder):
    chosen = thin_out(folder_examples(folder), stride=2, max_per_label=3)
    assert [Path(e.name).name for e in chosen if e.label == "discs"] == [
        "00.png",
        "04.png",
        "10.png",
    ]
    assert len(chosen) == 9


def test_words_are_learned_from_a_bounded_sample(folder):
    few = settings(n_epochs=1, max_descriptors=150)
    assert train(folder_examples(folder), FEATURES, few).training["descriptors"] == 150


def test_one_label_is_too_few(folder):
    examples = [e for e in folder_examples(folder) if e.label == "discs"]
    with pytest.raises(SemanticsError, match="at least two labels; got discs"):
        train(examples, FEATURES, SETTINGS)


@pytest.mark.parametrize("name", ["none", "empty"])
def test_a_folder_without_images_is_refused(tmp_path, name):
    (tmp_path / "empty" / "office").mkdir(parents=True)
    with pytest.raises(SemanticsError, match="no training images"):
        folder_examples(tmp_path / name)


def test_a_sequence_without_places_is_refused():
    film = Film()
    film.places = None
    with pytest.raises(SemanticsError, match=r"places\.csv"):
        sequence_examples(film)
    film.places = PlaceTruth(np.array([900.0]), ("discs",), ("",))
    with pytest.raises(SemanticsError, match=r"places\.csv"):
        sequence_examples(film)
