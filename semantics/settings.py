"""The high layer's settings, one part a module."""

from __future__ import annotations

from datasets.settings import Settings
from semantics.labeller import LabellerSettings
from semantics.parts import ExtentSettings
from semantics.presets import TrainingSettings
from semantics.topology import TopologySettings


class SemanticsSettings(Settings):
    """All settings of the high layer."""

    training: TrainingSettings = TrainingSettings()
    labeller: LabellerSettings = LabellerSettings()
    topology: TopologySettings = TopologySettings()
    extents: ExtentSettings = ExtentSettings()
