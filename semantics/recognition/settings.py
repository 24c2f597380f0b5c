"""Settings of the training of a place model."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pydantic import Field, field_validator

from roomgraph.datasets.plugins import known_name, settings_by_name
from roomgraph.datasets.settings import Settings
from roomgraph.semantics.classifiers.classifier import PlaceClassifier
from roomgraph.semantics.classifiers.registry import CLASSIFIERS
from roomgraph.semantics.descriptors.descriptor import ImageDescriptor
from roomgraph.semantics.descriptors.registry import DESCRIPTORS
from roomgraph.slam.features.extraction import FeatureSettings

if TYPE_CHECKING:
    DescriptorSettings = Settings
    ClassifierSettings = Settings
else:
    DescriptorSettings = settings_by_name("DescriptorSettings", __name__, DESCRIPTORS)
    ClassifierSettings = settings_by_name("ClassifierSettings", __name__, CLASSIFIERS)


class TrainingSettings(Settings):
    """Settings of the training of a place model."""

    descriptor: str = Field(default="fisher", description=f"one of {', '.join(DESCRIPTORS)}")
    classifier: str = Field(default="linear_svm", description=f"one of {', '.join(CLASSIFIERS)}")
    stride: int = Field(default=1, ge=1, description="every n-th image of each label is used")
    max_images_per_label: int = Field(
        default=200, ge=2, description="maximum number of images of each label, evenly spread"
    )
    threads: int = Field(
        default=2, ge=1, le=64, description="number of images read and described in parallel"
    )
    reject: float = Field(
        default=0.01, ge=0, lt=1,
        description="share of held-out images that may be labelled unknown so that novel places "
        "are rejected",
    )  # fmt: skip
    exemplars: int = Field(
        default=100, ge=0,
        description="number of images of each label kept in the model, so that it can learn other"
        " labels later",
    )  # fmt: skip
    descriptors: DescriptorSettings = DescriptorSettings()
    classifiers: ClassifierSettings = ClassifierSettings()

    @field_validator("descriptor")
    @classmethod
    def _is_descriptor(cls, name: str) -> str:
        return known_name(name, DESCRIPTORS)

    @field_validator("classifier")
    @classmethod
    def _is_classifier(cls, name: str) -> str:
        return known_name(name, CLASSIFIERS)

    def make_descriptor(self, features: FeatureSettings) -> ImageDescriptor:
        """Return the selected descriptor, untrained.

        Parameters
        ----------
        features : FeatureSettings
            How local features are extracted, should it look at any.
        """
        settings: Settings = getattr(self.descriptors, self.descriptor)
        return DESCRIPTORS[self.descriptor](settings, features)

    def make_classifier(self) -> PlaceClassifier:
        """Return the selected classifier, untrained."""
        settings: Settings = getattr(self.classifiers, self.classifier)
        return CLASSIFIERS[self.classifier](**settings.model_dump())
