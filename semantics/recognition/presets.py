"""What is learned from how many images: the settings of training, and named presets of them."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from roomgraph.datasets.settings import Settings
from roomgraph.semantics.descriptors.dense import DenseSettings
from roomgraph.semantics.descriptors.histogram import Normalisation
from roomgraph.slam.features.extraction import FeatureSettings


class FisherSettings(Settings):
    """How images are described as a whole."""

    n_words: int = Field(64, ge=2, le=4096, description="Gaussians, started from Neural Gas words")
    n_components: int = Field(64, ge=2, le=128, description="principal axes of the descriptors")
    em_steps: int = Field(10, ge=0, le=1000, description="steps of expectation maximisation")
    dense: DenseSettings = DenseSettings()


class TrainingSettings(Settings):
    """What is learned from how many images."""

    stride: int = Field(1, ge=1, description="every n-th image of each label is used")
    max_images_per_label: int = Field(200, ge=2, description="at most so many, evenly spread")
    n_words: int = Field(100, ge=2, le=10000, description="visual words (paper: 100)")
    n_epochs: int = Field(5, ge=1, le=1000, description="Neural Gas passes over the descriptors")
    max_descriptors: int = Field(
        200_000, ge=100, description="the words are learned from a sample of so many descriptors"
    )
    normalisation: Normalisation = Field(
        "hellinger", description="histograms the SVM sees: l1 (paper), l2 or hellinger"
    )
    encoding: Literal["words", "fisher"] = Field(
        "fisher", description="what the SVM sees: histograms of words (paper), or Fisher vectors"
    )
    C: float = Field(10.0, gt=0, description="penalty of the SVM (paper: 10)")
    min_features: int = Field(
        5, ge=1, description="an image with fewer features than this is of an unknown place"
    )
    threads: int = Field(2, ge=1, le=64, description="images read and described at once")
    reject: float = Field(
        0.01, ge=0, lt=1,
        description="share of held-out images that may be called unknown to keep strange ones out",
    )  # fmt: skip
    exemplars: int = Field(
        100, ge=0,
        description="images of each label kept in the model, so that it can take in others later",
    )  # fmt: skip
    fisher: FisherSettings = FisherSettings()


# What the SVM sees in the paper: shares of 100 words of SIFT features that pass a strict threshold.
PAPER = TrainingSettings(encoding="words", normalisation="l1", C=10.0, reject=0.0)
PAPER_FEATURES = FeatureSettings(detector="sift", contrast_threshold=0.04)
# Found by cross-validation on training photographs alone, see the README.
BEST = TrainingSettings()

Preset = Literal["paper", "best"]


def preset(name: Preset) -> tuple[TrainingSettings, FeatureSettings]:
    """Return the settings of a named preset, and the features it is made for."""
    return (PAPER, PAPER_FEATURES) if name == "paper" else (BEST, FeatureSettings())
