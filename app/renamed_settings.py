"""Settings that had another name in version 0.1.0."""

from __future__ import annotations

# Dotted names, the old one first; of a table all settings in it.
RENAMED = {
    "slam.window": "slam.local_bundle_adjustment",
    "slam.loops.belief": "slam.loops.verification",
    "slam.appearance": "slam.word_index",
    "slam.leaning": "slam.depth_refinement",
    "slam.textureless": "slam.depth_odometry",
    "slam.map.carve": "slam.map.remove_dynamic",
    "slam.ground": "slam.floor_plane",
    "slam.space": "slam.occupancy_volume",
    "semantics.training.encoding": "semantics.training.descriptor",
    "semantics.training.C": "semantics.training.classifiers.linear_svm.C",
    "semantics.training.lessons": "semantics.training.exemplars",
    "semantics.training.n_words": "semantics.training.descriptors.words.n_words",
    "semantics.training.n_epochs": "semantics.training.descriptors.words.n_epochs",
    "semantics.training.max_descriptors": "semantics.training.descriptors.words.max_descriptors",
    "semantics.training.normalisation": "semantics.training.descriptors.words.normalisation",
    "semantics.training.min_features": "semantics.training.descriptors.words.min_features",
    "semantics.training.fisher": "semantics.training.descriptors.fisher",
    "semantics.extents": "semantics.rooms",
    "checks.mend": "checks.correct_camera",
}


def new_name(name: str) -> str | None:
    """Return what a setting of version 0.1.0 is called now, None if its name has not changed."""
    for old, new in RENAMED.items():
        if name == old or name.startswith(f"{old}."):
            return new + name.removeprefix(old)
    return None


def old_name(name: str) -> str | None:
    """Return what a setting, or a table of them, was called in version 0.1.0, if otherwise."""
    return next((old for old, new in RENAMED.items() if new == name), None)
