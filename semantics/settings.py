"""Settings of the semantic layer, with a table for each module."""

from __future__ import annotations

from roomgraph.datasets.settings import Settings
from roomgraph.semantics.graph.topology import TopologySettings
from roomgraph.semantics.recognition.settings import TrainingSettings
from roomgraph.semantics.rooms.labelling import RoomSettings
from roomgraph.semantics.temporal.settings import LabellerSettings


class SemanticsSettings(Settings):
    """All settings of the semantic layer."""

    training: TrainingSettings = TrainingSettings()
    labeller: LabellerSettings = LabellerSettings()
    topology: TopologySettings = TopologySettings()
    rooms: RoomSettings = RoomSettings()
