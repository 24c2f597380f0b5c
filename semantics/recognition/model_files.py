"""Place models on disk: a folder with model.json and arrays.npz, no pickle in either."""

from __future__ import annotations

import os
import shutil
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from roomgraph.datasets.files import is_working_folder, replace_folder, replacing
from roomgraph.semantics.classifiers.classifier import PlaceClassifier
from roomgraph.semantics.classifiers.registry import CLASSIFIERS
from roomgraph.semantics.descriptors.descriptor import ImageDescriptor
from roomgraph.semantics.descriptors.registry import DESCRIPTORS
from roomgraph.semantics.documents import read_document, write_document
from roomgraph.semantics.errors import SemanticsError
from roomgraph.semantics.labels import LabelSpace
from roomgraph.semantics.recognition.model import Exemplars, PlaceModel
from roomgraph.semantics.recognition.model_versions import from_version_2
from roomgraph.slam.features.extraction import FeatureSettings

SCHEMA, VERSION = "roomgraph/place-model", 3
DOCUMENT, ARRAYS = "model.json", "arrays.npz"
# Names of arrays are those of a part and of its own arrays.
_DESCRIPTOR, _CLASSIFIER, _EXEMPLARS = "descriptor.", "classifier.", "exemplars."

Arrays = dict[str, NDArray[Any]]


def save_model(path: Path, model: PlaceModel, overwrite: bool = False) -> None:
    """Write a model to the folder `path`, completely or not at all.

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
        with replacing(temporary / ARRAYS) as arrays, arrays.open("wb") as file:
            np.savez_compressed(file, allow_pickle=False, **_arrays(model))
        replace_folder(temporary, path)
    finally:
        shutil.rmtree(temporary, ignore_errors=True)


def refuse_other(path: Path, overwrite: bool) -> None:
    """Raise if a model may not be written; call this before training.

    Raises
    ------
    SemanticsError
        `path` exists and `overwrite` is false, or it holds something that is not a model.
    """
    if is_working_folder(path):
        raise SemanticsError(
            "the working folder cannot be replaced", where=path, expected="a folder of its own",
            hint="choose another output",
        )  # fmt: skip
    if not path.exists():
        return
    if not overwrite:
        raise SemanticsError("the model exists already", where=path, hint="add --overwrite")
    if not (path / DOCUMENT).is_file() and (not path.is_dir() or any(path.iterdir())):
        raise SemanticsError(
            "refusing to overwrite what is not a place model", where=path,
            expected=f"a folder with {DOCUMENT}", hint="choose another output",
        )  # fmt: skip


def load_model(path: str | Path) -> PlaceModel:
    """Read a model that `save_model` wrote, also one of version 2.

    Raises
    ------
    SemanticsError
        `path` is not a folder with a whole model in it.
    """
    path = Path(path)
    if not (path / DOCUMENT).is_file():
        raise SemanticsError(
            "not a place model", where=path, expected=f"a folder with {DOCUMENT} and {ARRAYS}",
            hint="train one with: roomgraph train DATA -o MODEL",
        )  # fmt: skip
    content = read_document(path / DOCUMENT, SCHEMA, VERSION, 2)
    arrays = _read_arrays(path / ARRAYS)
    try:
        if content["version"] == 2:
            content, arrays = from_version_2(content, arrays)
        return _build(content, arrays)
    except (KeyError, TypeError, ValueError, ValidationError) as error:
        raise SemanticsError(
            "invalid place model", where=path, got=f"{type(error).__name__} {error}",
            hint="train it again",
        ) from error  # fmt: skip


def _content(model: PlaceModel) -> dict[str, Any]:
    descriptor, classifier, features = model.descriptor, model.classifier, model.features
    names = type(classifier).settings_class.model_fields
    return {
        "labels": list(model.labels.names),
        "colours": [list(colour) for colour in model.labels.colours],
        "descriptor": {
            "name": descriptor.name,
            "settings": descriptor.settings.model_dump(),
            "features": None if features is None else features.model_dump(),
        },
        "classifier": {
            "name": classifier.name,
            "settings": {name: getattr(classifier, name) for name in names},
            "classes": [str(name) for name in classifier.classes_],
        },
        "training": {k: None if v != v else v for k, v in model.training.items()},
        "reject_below": model.reject_below,
    }


def _arrays(model: PlaceModel) -> Arrays:
    arrays = {_DESCRIPTOR + name: array for name, array in model.descriptor.arrays().items()}
    arrays |= {_CLASSIFIER + name: array for name, array in model.classifier.arrays().items()}
    if model.exemplars is not None:
        for name in ("vectors", "labels", "groups"):
            arrays[_EXEMPLARS + name] = getattr(model.exemplars, name)
    return arrays | {"transitions": model.transitions}


def _build(content: dict[str, Any], arrays: Arrays) -> PlaceModel:
    for name, array in arrays.items():
        if array.dtype.kind == "f" and not np.isfinite(array).all():
            raise ValueError(f"{name} is not finite")
    labels = LabelSpace(
        tuple(content["labels"]), tuple((r, g, b) for r, g, b in content["colours"])
    )
    descriptor = _descriptor(content["descriptor"], _part(arrays, _DESCRIPTOR))
    classifier = _classifier(content["classifier"], _part(arrays, _CLASSIFIER))
    if set(classifier.classes_) != set(labels.names[1:]):
        raise ValueError("classes that differ from the labels")
    if classifier.n_features_in_ != descriptor.length:
        raise ValueError(
            f"a classifier of {classifier.n_features_in_} numbers behind a descriptor of "
            f"{descriptor.length}"
        )
    kinds = len(labels) - 1
    if arrays["transitions"].shape != (kinds, kinds):
        raise ValueError(f"transitions of shape {arrays['transitions'].shape}")
    return PlaceModel(
        labels=labels, descriptor=descriptor, classifier=classifier, training=content["training"],
        reject_below=float(content["reject_below"]), transitions=arrays["transitions"],
        exemplars=_exemplars(_part(arrays, _EXEMPLARS), descriptor.length),
    )  # fmt: skip


def _descriptor(content: dict[str, Any], arrays: Arrays) -> ImageDescriptor:
    made = _known(DESCRIPTORS, content["name"], "descriptor")
    features = content["features"]
    descriptor: ImageDescriptor = made(
        made.settings_class(**content["settings"]),
        None if features is None else FeatureSettings(**features),
    )
    return descriptor.with_arrays(arrays)


def _classifier(content: dict[str, Any], arrays: Arrays) -> PlaceClassifier:
    made = _known(CLASSIFIERS, content["name"], "classifier")
    settings = made.settings_class(**content["settings"])
    classifier: PlaceClassifier = made(**settings.model_dump())
    return classifier.with_arrays(content["classes"], arrays)


def _known(classes: dict[str, Any], name: str, what: str) -> Any:
    if name not in classes:
        raise ValueError(f"{what} {name!r}, expected {' or '.join(classes)}")
    return classes[name]


def _exemplars(arrays: Arrays, length: int) -> Exemplars | None:
    if not arrays:
        return None
    vectors, labels, groups = (arrays[name] for name in ("vectors", "labels", "groups"))
    if vectors.shape != (len(labels), length) or len(groups) != len(labels):
        raise ValueError(f"exemplars of shape {vectors.shape}")
    return Exemplars(vectors, labels, groups)


def _part(arrays: Arrays, prefix: str) -> Arrays:
    """Return the arrays whose names begin with a prefix, without it."""
    return {n.removeprefix(prefix): a for n, a in arrays.items() if n.startswith(prefix)}


def _read_arrays(path: Path) -> Arrays:
    try:
        with path.open("rb") as file, np.load(file, allow_pickle=False) as arrays:
            return {name: arrays[name] for name in arrays.files}
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile) as error:
        raise SemanticsError(
            "the model's arrays cannot be read", where=path,
            got=f"{type(error).__name__} {error}", hint="train it again",
        ) from error  # fmt: skip
