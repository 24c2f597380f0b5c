"""Place models of earlier versions, as they would be written today."""

from __future__ import annotations

from typing import Any

from numpy.typing import NDArray

Arrays = dict[str, NDArray[Any]]

# Before the names of the Fisher encoder's arrays.
_DENSE = "dense_"
_EXEMPLARS = {"lesson_vectors": "vectors", "lesson_labels": "labels", "lesson_groups": "groups"}


def from_version_2(content: dict[str, Any], arrays: Arrays) -> tuple[dict[str, Any], Arrays]:
    """Return what version 3 holds of a model of version 2.

    That knew two descriptors (words, and Fisher vectors beside words) and one classifier.

    Raises
    ------
    KeyError
        Something is missing.
    """
    words = {
        "n_words": len(arrays["prototypes"]),
        "normalisation": content["normalisation"],
        "min_features": content["min_features"],
    }
    is_dense = content["dense"] is not None
    fisher = {"dense": content["dense"], "signature": words}
    if is_dense:
        fisher |= {
            "n_words": len(arrays[_DENSE + "weights"]),
            "n_components": int(arrays[_DENSE + "projection"].shape[1]),
        }
    kept = {key: content[key] for key in ("labels", "colours", "training", "reject_below")}
    descriptor = {
        "name": "fisher" if is_dense else "words",
        "settings": fisher if is_dense else words,
        "features": content["features"],
    }
    classifier = {"name": "linear_svm", "settings": {}, "classes": content["classes"]}
    return {**kept, "descriptor": descriptor, "classifier": classifier}, _arrays(arrays, is_dense)


def _arrays(arrays: Arrays, is_dense: bool) -> Arrays:
    """Return the arrays under the names that version 3 gives them."""
    prototypes = "descriptor.signature_prototypes" if is_dense else "descriptor.prototypes"
    renamed = {"transitions": arrays["transitions"], prototypes: arrays["prototypes"]}
    for name in ("coef", "intercept", "sigmoid", "scaling"):
        renamed["classifier." + name] = arrays[name]
    for name, array in arrays.items():
        if name.startswith(_DENSE):
            renamed["descriptor." + name.removeprefix(_DENSE)] = array
        elif name in _EXEMPLARS:
            renamed["exemplars." + _EXEMPLARS[name]] = array
    return renamed
