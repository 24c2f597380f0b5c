"""Place models on disk: a folder with model.json and arrays.npz, no pickle in either."""

from __future__ import annotations

import os
import shutil
import zipfile
from pathlib import Path
from typing import Any, get_args

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from roomgraph.semantics.classifiers.linear_svm import PlaceClassifier
from roomgraph.semantics.descriptors.dense import DenseSettings
from roomgraph.semantics.descriptors.fisher import ARRAYS as ENCODER_ARRAYS
from roomgraph.semantics.descriptors.fisher import FisherEncoder
from roomgraph.semantics.descriptors.histogram import BagOfFeatures, Normalisation
from roomgraph.semantics.descriptors.neural_gas import NeuralGas
from roomgraph.semantics.documents import read_document, write_document
from roomgraph.semantics.errors import SemanticsError
from roomgraph.semantics.labels import LabelSpace
from roomgraph.semantics.recognition.model import Exemplars, PlaceModel
from roomgraph.slam.features.extraction import FeatureSettings

SCHEMA, VERSION = "roomgraph/place-model", 2
DOCUMENT, ARRAYS = "model.json", "arrays.npz"
# Of the encoder's arrays, which lie beside the others.
PREFIX = "dense_"


def save_model(path: Path, model: PlaceModel, overwrite: bool = False) -> None:
    """Write a model to the folder `path`, whole or not at all.

    Raises
    ------
    SemanticsError
        `path` exists and `overwrite` is false, or it holds something that is not a model.
    """
    refuse_other(path, overwrite)
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    temporary.mkdir()
    try:
        write_document(temporary / DOCUMENT, SCHEMA, VERSION, _content(model))
        np.savez_compressed(temporary / ARRAYS, allow_pickle=False, **_arrays(model))
        if path.exists():
            shutil.rmtree(path)
        temporary.rename(path)
    finally:
        shutil.rmtree(temporary, ignore_errors=True)


def refuse_other(path: Path, overwrite: bool) -> None:
    """Raise where a model may not be written: to be asked before it is learned.

    Raises
    ------
    SemanticsError
        `path` exists and `overwrite` is false, or it holds something that is not a model.
    """
    if not path.exists():
        return
    if not overwrite:
        raise SemanticsError("the model exists already", where=path, hint="add --overwrite")
    if not (path / DOCUMENT).is_file() and (not path.is_dir() or any(path.iterdir())):
        raise SemanticsError(
            "refusing to replace what is not a place model", where=path,
            expected=f"a folder with {DOCUMENT}", hint="choose another output",
        )  # fmt: skip


def load_model(path: Path) -> PlaceModel:
    """Read a model that `save_model` wrote.

    Raises
    ------
    SemanticsError
        `path` is not a folder with a whole model in it.
    """
    if not (path / DOCUMENT).is_file():
        raise SemanticsError(
            "not a place model", where=path, expected=f"a folder with {DOCUMENT} and {ARRAYS}",
            hint="train one with: roomgraph train DATA -o MODEL",
        )  # fmt: skip
    content = read_document(path / DOCUMENT, SCHEMA, VERSION)
    arrays = _read_arrays(path / ARRAYS)
    try:
        return _build(content, arrays)
    except (KeyError, TypeError, ValueError, ValidationError) as error:
        raise SemanticsError(
            "place model not understood", where=path, got=f"{type(error).__name__} {error}",
            hint="train it again",
        ) from error  # fmt: skip


def _content(model: PlaceModel) -> dict[str, Any]:
    return {
        "labels": list(model.labels.names),
        "colours": [list(colour) for colour in model.labels.colours],
        "classes": [str(name) for name in model.classifier.classes_],
        "features": model.features.model_dump(),
        "normalisation": model.normalisation,
        "min_features": model.min_features,
        "training": {k: None if v != v else v for k, v in model.training.items()},
        "dense": None if model.encoder is None else model.encoder.settings.model_dump(),
        "reject_below": model.reject_below,
    }


def _arrays(model: PlaceModel) -> dict[str, NDArray[Any]]:
    arrays = {
        "prototypes": model.bag.vocabulary.prototypes_,
        "coef": model.classifier.coef_,
        "intercept": model.classifier.intercept_,
        "sigmoid": model.classifier.sigmoid_,
        "scaling": model.classifier.scaling_,
        "transitions": model.transitions,
    }
    if model.exemplars is not None:
        arrays["lesson_vectors"] = model.exemplars.vectors
        arrays["lesson_labels"] = model.exemplars.labels
        arrays["lesson_groups"] = model.exemplars.groups
    if model.encoder is not None:
        arrays |= {PREFIX + name: array for name, array in model.encoder.arrays.items()}
    return arrays


def _build(content: dict[str, Any], arrays: dict[str, NDArray[Any]]) -> PlaceModel:
    classes, prototypes = content["classes"], arrays["prototypes"]
    encoder = _encoder(content, arrays)
    labels = LabelSpace(
        tuple(content["labels"]), tuple((r, g, b) for r, g, b in content["colours"])
    )
    _check_shapes(arrays, len(classes), len(prototypes) if encoder is None else encoder.length)
    if content["normalisation"] not in get_args(Normalisation):
        raise ValueError(f"normalisation {content['normalisation']!r}")
    if set(classes) != set(labels.names[1:]):
        raise ValueError("classes that are not the labels")
    return PlaceModel(
        labels,
        BagOfFeatures(NeuralGas.from_prototypes(prototypes)),
        PlaceClassifier.from_arrays(
            classes, arrays["coef"], arrays["intercept"], arrays["sigmoid"], arrays["scaling"]
        ),
        FeatureSettings(**content["features"]),
        content["normalisation"],
        int(content["min_features"]),
        content["training"],
        encoder,
        float(content["reject_below"]),
        arrays["transitions"],
        _exemplars(arrays),
    )


def _exemplars(arrays: dict[str, NDArray[Any]]) -> Exemplars | None:
    if "lesson_vectors" not in arrays:
        return None
    names = ("lesson_vectors", "lesson_labels", "lesson_groups")
    vectors, labels, groups = (arrays[name] for name in names)
    if vectors.shape != (len(labels), arrays["coef"].shape[1]) or len(groups) != len(labels):
        raise ValueError(f"exemplars of shape {vectors.shape}")
    return Exemplars(vectors, labels, groups)


def _encoder(content: dict[str, Any], arrays: dict[str, NDArray[Any]]) -> FisherEncoder | None:
    if content["dense"] is None:
        return None
    return FisherEncoder(
        DenseSettings(**content["dense"]), {name: arrays[PREFIX + name] for name in ENCODER_ARRAYS}
    )


def _check_shapes(arrays: dict[str, NDArray[Any]], n_classes: int, length: int) -> None:
    prototypes = arrays["prototypes"]
    expected = {
        "prototypes": (len(prototypes), prototypes.shape[-1]),
        "coef": (n_classes, length),
        "intercept": (n_classes,),
        "sigmoid": (n_classes, 2),
        "scaling": (n_classes + 1,),
        "transitions": (n_classes, n_classes),
    }
    for name, shape in expected.items():
        if arrays[name].shape != shape or not np.isfinite(arrays[name]).all():
            raise ValueError(f"{name} of shape {arrays[name].shape}, expected finite {shape}")


def _read_arrays(path: Path) -> dict[str, NDArray[Any]]:
    try:
        with path.open("rb") as file, np.load(file, allow_pickle=False) as arrays:
            return {name: arrays[name] for name in arrays.files}
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile) as error:
        raise SemanticsError(
            "the model's arrays cannot be read", where=path,
            got=f"{type(error).__name__} {error}", hint="train it again",
        ) from error  # fmt: skip
