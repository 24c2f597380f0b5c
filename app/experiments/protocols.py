"""The experiments of the paper."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from roomgraph.app.console import Terminal
from roomgraph.app.errors import AppError
from roomgraph.app.experiments.data import Describer
from roomgraph.app.experiments.finished_run import FINISHED, FinishedRun, finished_run
from roomgraph.app.experiments.material import Material, gather
from roomgraph.app.experiments.report import ProtocolReport
from roomgraph.app.experiments.visible_rooms import route_positions
from roomgraph.app.experiments.walks import SEEDS, STRIDE, data_walks
from roomgraph.app.learning.training import Recipe
from roomgraph.app.settings import AppSettings
from roomgraph.datasets.errors import RoomgraphError
from roomgraph.semantics.evaluation import splits
from roomgraph.semantics.evaluation.open_set import evaluate_open_set
from roomgraph.semantics.evaluation.route import route_results
from roomgraph.semantics.evaluation.splits import SplitResult

PERMUTATIONS = 100
# Across light, twice as many images: those learned from, and those halfway between.
LIGHT_STRIDE = STRIDE // 2


def run_protocol(
    name: str,
    recipe: Recipe,
    settings: AppSettings,
    data: Sequence[Path],
    terminal: Terminal,
    seeds: Sequence[int] = SEEDS,
) -> ProtocolReport:
    """Run an experiment on rendered buildings, or on the user's data.

    Parameters
    ----------
    name : str
        One of `PROTOCOLS`.
    recipe : Recipe
        What place models are made of, in place of what the settings say.
    settings : AppSettings
        Of everything else.
    data : sequence of Path
        The user's folders or sequences; none for rendered buildings.
    terminal : Terminal
        Shows progress.
    seeds : sequence of int
        Of the rendered buildings.

    Raises
    ------
    AppError
        There is no experiment of that name, or the data are not of the kind that it needs.
    """
    if name not in PROTOCOLS:
        raise AppError(
            "no such experiment", where="--protocol", expected=" or ".join(PROTOCOLS), got=name
        )
    settings = recipe.applied(settings)
    if name == "recognition" and len(data) == 1 and (data[0] / "test").is_dir():
        report = _train_and_test(settings, data[0], terminal)
    else:
        stride = LIGHT_STRIDE if name == "light" else STRIDE
        report = PROTOCOLS[name](gather(settings, data, terminal, seeds, stride))
    return replace(report, name=name, training=settings.semantics.training)


def _recognition(m: Material) -> ProtocolReport:
    lights = len(set(m.evaluation_set.lights.tolist()))
    knows_doorways = lights > 1 and len(m.evaluation_set.doorway_m) > 0
    knows_visible_rooms = lights > 1 and len(m.evaluation_set.visible) > 0
    total = splits.N_FOLDS * (lights + 1 + (lights > 1) + knows_doorways + knows_visible_rooms)
    found = m.watched("Recognition", splits.recognition(m.evaluation_set, m.settings.seed), total)
    last = found[-1].row
    aside = (last, splits.AWAY, splits.BY_VISIBLE_ROOM)
    rows = tuple(dict.fromkeys(t.row for t in found if t.row not in aside))
    notes = [
        "Ten folds. In each light, whole visits to rooms are held out; fused, rooms are held out "
        "in all lights at once. A class with a single visit is split into blocks of its frames.",
        f"The row '{last}' assigns single frames to folds, as the paper does. It does not "
        "count in the headline.",
    ]
    if knows_doorways:
        notes.append(
            f"The row '{splits.AWAY}' is a part of the row 'fused': an image is labelled with the "
            "room it was taken in, but near a doorway it shows the next room. It does not count "
            "either."
        )
    figures = {}
    if knows_visible_rooms:
        hardly = float(np.mean(m.evaluation_set.own_share < splits.HARDLY))
        figures = {"hardly_show_their_room": round(hardly, 4)}
        notes.append(
            f"According to depth and floor plan, {hardly:.1%} of the images show nothing of the "
            "room they were taken in: their label cannot be seen. In the row "
            f"'{splits.BY_VISIBLE_ROOM}' an image is labelled with the room that most of it "
            "shows, and that room is held out. It does not count either."
        )
    return ProtocolReport(
        data=m.data, results=found, notes=(*notes, *m.notes), headline=rows, figures=figures
    )


def _light(m: Material) -> ProtocolReport:
    lights, buildings = (
        set(m.evaluation_set.lights.tolist()),
        set(m.evaluation_set.buildings.tolist()),
    )
    if len(lights) < 2:
        raise AppError("only one light", expected="the same rooms in two lights, a folder for each")
    if len(buildings) == len(lights):
        # Folders of the user: each is a light, and all show one building.
        same = np.full(len(m.evaluation_set.labels), "data")
        m = replace(m, evaluation_set=replace(m.evaluation_set, buildings=same))
        buildings = {"data"}
    split = len(m.evaluation_set.order) > 0
    count = len(lights) * len(buildings)
    total = count * (len(lights) - 1) * 3 + count * 2 if split else count * (len(lights) - 1)
    found = m.watched("Across light", splits.light(m.evaluation_set), total)
    notes = ["Trained in one light and tested in another, in each building (paper, Table 2)."]
    if split:
        notes.append(
            "Each light has the same walk, as in the paper. Every fourth image is for training, "
            "and those halfway between, 0.3 m or 16 degrees away, are for testing."
        )
        notes.append(
            "Other stretches, which do not count in the headline: stretches of 2.5 m or a third of "
            "a turn are used alternately for training and testing, so that no view recurs. The "
            "same light is tested too, to find which part of the loss is due to the light."
        )
    aside = (splits.STRETCHES, splits.STRETCHES_SAME_LIGHT)
    rows = tuple(dict.fromkeys(t.row for t in found if t.row not in aside))
    return ProtocolReport(data=m.data, results=found, notes=(*notes, *m.notes), headline=rows)


def _building(m: Material) -> ProtocolReport:
    buildings = set(m.evaluation_set.buildings.tolist())
    if len(buildings) < 2:
        raise AppError("only one building", expected="two or more folders with --data")
    found = m.watched(
        "Other buildings",
        splits.building(m.evaluation_set, m.settings.seed, PERMUTATIONS),
        PERMUTATIONS,
    )
    open_set = None
    if len(buildings) > 2:
        with m.terminal.progress("Probabilities") as advance:
            open_set = evaluate_open_set(
                m.evaluation_set, lambda done, total: advance(done, total, "")
            )
    notes = (
        f"{PERMUTATIONS} permutations: trained on half of the images of half of the buildings, "
        "tested on the other buildings, then the other way round (the paper's Fig. 15).",
        "Probabilities: each building is left out in turn. Unknown: each kind of place is left out "
        "of training, and an unseen building is tested.",
        *m.notes,
    )
    return ProtocolReport(data=m.data, results=found, notes=notes, open_set=open_set)


def _route(m: Material) -> ProtocolReport:
    names = list(dict.fromkeys(walk.building for walk in m.walks))
    if len(names) < 2:
        raise AppError("only one building", expected="folders to train on, then the route")
    routes = [walk for walk in m.walks if walk.light == "day"] or m.walks[-1:]
    found: list[SplitResult] = []
    runs: list[FinishedRun] = []
    novel: set[str] = set()
    for done, walk in enumerate(routes, 1):
        images = m.describer.prepare(walk.examples, f"Route {done} of {len(routes)}")
        model = m.model_without(walk.building)
        novel |= {image.example.label for image in images} - set(model.labels.names)
        found += route_results(
            model, m.describer.predictions(model, images),
            [image.example.label for image in images],
            route_positions([image.example for image in images]), m.settings.semantics.labeller,
        )  # fmt: skip
        try:
            runs.append(finished_run(model, walk.root, m.settings, m.terminal))
        except RoomgraphError as error:
            m.terminal.warn(f"route not mapped: {error}")
    found += [result for run in runs for result in (run.nodes, run.frames)]
    notes = [
        "Each route is labelled by a model of the other buildings. A node is added each metre; "
        "its label is that of its own frame, or of the vote of the frames around it (the paper's "
        "Fig. 16).",
        "Filter: a hidden Markov model with the delay of the vote (the default). Smoothed: beliefs "
        "propagated over the finished graph.",
    ]
    if novel:
        notes.append(f"Not in the training data of the model: {', '.join(sorted(novel))}.")
    figures = {}
    if runs:
        figures = {
            "rooms": sum(run.rooms for run in runs),
            "rooms_told_apart": sum(run.told_apart for run in runs),
        }
        notes.append(
            "Finished run: the graph that `roomgraph run` writes for the route. Only keyframes are "
            "classified, and all nodes and frames of a room get the label that its frames voted "
            f"for. Separated rooms: {figures['rooms_told_apart']} of "
            f"{figures['rooms']}."
        )
    headline = (FINISHED,) if runs else ("nodes, vote",)
    return ProtocolReport(
        data=m.data, results=tuple(found), notes=(*notes, *m.notes), headline=headline,
        figures=figures,
    )  # fmt: skip


PROTOCOLS: dict[str, Callable[[Material], ProtocolReport]] = {
    "recognition": _recognition,
    "light": _light,
    "building": _building,
    "route": _route,
}


def _train_and_test(settings: AppSettings, root: Path, terminal: Terminal) -> ProtocolReport:
    """Train on the folder ``train``, test on the folder ``test``."""
    train, test = (data_walks([root / part])[0].examples for part in ("train", "test"))
    describer = Describer(settings, train, terminal)
    images = describer.prepare(test, "Describing test images")
    found = describer.model.classifier.predict(describer.vectors(images)).astype(str)
    truth = np.array([image.example.label for image in images])
    # The spread of five parts of the test images says how far the figure can be trusted.
    parts = np.array_split(np.random.default_rng(settings.seed).permutation(len(truth)), 5)
    results = [SplitResult("train to test, fifths", truth[part], found[part]) for part in parts]
    accuracy: Any = describer.model.training["cross_validated_accuracy"]
    notes = (
        f"Trained on {root.name}/train only, tested on {root.name}/test; std over five parts.",
        f"Cross-validated on the training images: {accuracy:.1%}.",
    )
    return ProtocolReport(data=(str(root),), results=tuple(results), notes=notes)
