"""All classifiers by name: a new one is a file beside this one and a line here."""

from __future__ import annotations

from roomgraph.datasets.plugins import classes_by_name
from roomgraph.semantics.classifiers.classifier import PlaceClassifier

CLASSIFIERS: dict[str, type[PlaceClassifier]] = classes_by_name(
    "roomgraph.semantics.classifiers",
    "linear_svm.LinearSvm",
)
