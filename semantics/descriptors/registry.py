"""All image descriptors by name: a new one is a file beside this one and a line here."""

from __future__ import annotations

from roomgraph.datasets.plugins import classes_by_name
from roomgraph.semantics.descriptors.descriptor import ImageDescriptor

DESCRIPTORS: dict[str, type[ImageDescriptor]] = classes_by_name(
    "roomgraph.semantics.descriptors",
    "words.WordsDescriptor",
    "fisher.FisherDescriptor",
)
