from dataclasses import replace

import numpy as np
import pytest

from roomgraph.semantics.classifiers.linear_svm import LinearSvm
from roomgraph.semantics.evaluation import splits
from roomgraph.semantics.evaluation.open_set import evaluate_open_set
from roomgraph.semantics.evaluation.splits import EvaluationSet


@pytest.fixture(scope="module")
def evaluation_set():
    """Four buildings in two lights; three kinds of place, two rooms each, five frames a visit."""
    rng = np.random.default_rng(0)
    kinds = ("bathroom", "kitchen", "office")
    rows = [
        (kind, building, light, room)
        for building in "abcd"
        for light in ("day", "night")
        for kind in kinds
        for room in (1, 2)
        for _ in range(5)
    ]
    vectors = np.array(
        [4 * np.eye(4)[kinds.index(kind)] + (light == "night") * np.eye(4)[3]
         for kind, _, light, _ in rows]
    )  # fmt: skip
    return EvaluationSet(
        vectors + rng.normal(0, 0.7, vectors.shape),
        np.array([kind for kind, *_ in rows]),
        np.array([f"{b}{light}{kind}{room}" for kind, b, light, room in rows]),
        np.array([f"{b}{kind}{room}" for kind, b, _, room in rows]),
        np.array([b for _, b, *_ in rows]),
        np.array([light for *_, light, _ in rows]),
        LinearSvm(C=1.0),
    )


def overlap(monkeypatch, groups, run):
    """Return the groups that any result of `run` has on both sides."""
    shared = set()
    original = splits.run_split

    def watched(evaluation_set, row, train, test):
        if "(paper)" not in row:
            shared.update(set(groups[train]) & set(groups[test]))
        return original(evaluation_set, row, train, test)

    monkeypatch.setattr(splits, "run_split", watched)
    return list(run()), shared


def test_recognition_holds_visits_out_whole(evaluation_set, monkeypatch):
    found, shared = overlap(
        monkeypatch, evaluation_set.visits, lambda: splits.recognition(evaluation_set, 0)
    )
    assert not shared
    assert list(dict.fromkeys(t.row for t in found)) == [
        "day", "night", "fused", "frames of one visit on both sides (paper)",
    ]  # fmt: skip
    for row in ("day", "night"):
        assert sum(len(t.truth) for t in found if t.row == row) == 120
    assert sum(len(t.truth) for t in found if t.row == "fused") == 240
    assert np.mean([t.accuracy for t in found]) > 0.95


def test_images_away_from_doorways_are_a_part_of_those_tested(evaluation_set):
    ways = np.tile([0.2, 0.9, 1.0, 3.0, np.inf], 48)
    found = list(splits.recognition(replace(evaluation_set, doorway_m=ways), 0))
    fused = [t for t in found if t.row == "fused"]
    away = [t for t in found if t.row == splits.AWAY]
    assert len(away) == len(fused) == 10
    for part, whole in zip(away, fused, strict=True):
        kept = ways[whole.tested] >= 1
        np.testing.assert_array_equal(part.found, whole.found[kept])
        np.testing.assert_array_equal(part.truth, evaluation_set.labels[part.tested])


def test_across_light_stays_in_a_building(evaluation_set, monkeypatch):
    found, shared = overlap(
        monkeypatch, evaluation_set.lights, lambda: splits.light(evaluation_set)
    )
    assert not shared
    assert len(found) == 2 * 4
    assert {t.row for t in found} == {"day to night", "night to day"}


def test_across_light_no_view_is_on_both_sides(evaluation_set, monkeypatch):
    order, stretches = np.tile(np.arange(5), 48), np.tile([0, 0, 1, 1, 1], 48)
    alternating = replace(evaluation_set, order=order, stretches=stretches)
    sides = []
    original = splits.run_split

    def watched(evaluation_set, row, train, test):
        along = stretches if "stretches" in row else order
        sides.append(set(along[train]) & set(along[test]))
        assert (row == splits.STRETCHES_SAME_LIGHT) == (
            set(evaluation_set.lights[train]) == set(evaluation_set.lights[test])
        )
        return original(evaluation_set, row, train, test)

    monkeypatch.setattr(splits, "run_split", watched)
    found = list(splits.light(alternating))
    assert len(found) == (1 + 2 + 2) * 2 * 4
    assert not any(sides)
    assert sum(len(t.truth) for t in found if t.row == splits.STRETCHES) == len(
        evaluation_set.labels
    )
    assert [t.row for t in found][:8] == ["day to night"] * 4 + ["night to day"] * 4


def test_another_building_is_never_learned_from(evaluation_set, monkeypatch):
    found, shared = overlap(
        monkeypatch, evaluation_set.buildings, lambda: splits.building(evaluation_set, 0, 6)
    )
    assert not shared
    assert [t.row for t in found] == ["there", "and back"] * 3
    again = list(splits.building(evaluation_set, 0, 6))
    assert [t.accuracy for t in again] == [t.accuracy for t in found]


def test_probabilities_are_of_buildings_left_out(evaluation_set):
    calls = []
    found = evaluate_open_set(evaluation_set, lambda *n: calls.append(n))
    assert calls == [(i, 7) for i in range(1, 8)]
    np.testing.assert_allclose(found.probabilities.sum(axis=1), 1)
    right = np.array(found.classes)[found.probabilities.argmax(axis=1)] == found.truth
    assert right.mean() > 0.95
    assert set(found.novel) == {"bathroom", "kitchen", "office"}
    for kind, novel in found.novel.items():
        assert len(novel) == 20
        assert np.median(novel) < np.median(found.known[kind])


def test_per_class_is_over_all_results():
    a = splits.SplitResult("x", np.array(["k", "k", "o"]), np.array(["k", "o", "o"]))
    b = splits.SplitResult("x", np.array(["k", "k"]), np.array(["k", "k"]))
    assert splits.per_class([a, b]) == {"k": 0.75, "o": 1.0}
    assert a.accuracy == pytest.approx(2 / 3)
    assert splits.per_class([a]) == {"k": 0.5, "o": 1.0}


def test_images_are_also_judged_by_what_they_show(evaluation_set, monkeypatch):
    """Every fifth image shows another kind of room than it was taken in; that room is held out."""
    visible, rooms = evaluation_set.labels.copy(), evaluation_set.rooms.copy()
    visible[::5], rooms[::5] = (
        np.roll(evaluation_set.labels, 10)[::5],
        np.roll(evaluation_set.rooms, 10)[::5],
    )
    vectors = evaluation_set.vectors.copy()
    vectors[::5] = np.roll(evaluation_set.vectors, 10, axis=0)[::5]
    misled = replace(evaluation_set, vectors=vectors, visible=visible, visible_room_names=rooms)
    shared = set()
    original = splits.run_split

    def watched(evaluation_set, row, train, test):
        if row == splits.BY_VISIBLE_ROOM:
            shared.update(set(rooms[train]) & set(rooms[test]))
        return original(evaluation_set, row, train, test)

    monkeypatch.setattr(splits, "run_split", watched)
    found = list(splits.recognition(misled, 0))
    right = {
        row: np.mean([t.accuracy for t in found if t.row == row])
        for row in ("fused", splits.BY_VISIBLE_ROOM)
    }
    assert not shared
    assert right[splits.BY_VISIBLE_ROOM] > 0.9
    assert right["fused"] < 0.85
