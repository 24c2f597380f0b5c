"""Named settings of training, with the local features that they are made for."""

from __future__ import annotations

from dataclasses import dataclass

from roomgraph.semantics.recognition.settings import TrainingSettings
from roomgraph.slam.features.extraction import FeatureSettings


@dataclass(frozen=True, slots=True)
class Preset:
    """Descriptor and classifier of a place model, and its local features."""

    training: TrainingSettings
    features: FeatureSettings


PRESETS: dict[str, Preset] = {
    # Found by cross-validation on training photographs alone, see the benchmarks.
    "best": Preset(TrainingSettings(), FeatureSettings()),
    # What the SVM sees in the paper: shares of 100 words of SIFT features above a high threshold.
    "paper": Preset(
        TrainingSettings.model_validate({
            "descriptor": "words", "reject": 0.0,
            "descriptors": {"words": {"normalisation": "l1"}},
        }),
        FeatureSettings(detector="sift", contrast_threshold=0.04),
    ),
}  # fmt: skip
