import numpy as np
import pytest
from pydantic import ValidationError

from roomgraph.semantics.temporal.labeller import PlaceLabeller
from roomgraph.semantics.temporal.look import FrameInput
from roomgraph.semantics.temporal.settings import LabellerSettings
from tests.semantics.helpers import frame


def run(model, words, window):
    labeller = PlaceLabeller(model, LabellerSettings(method="vote", window=window))
    released = [labeller.process(frame(i, word)) for i, word in enumerate(words)]
    return released, labeller.finish()


def test_labels_come_late_by_half_a_window_and_in_order(model):
    released, rest = run(model, [0] * 10, window=5)
    assert [len(labels) for labels in released] == [0, 0] + [1] * 8
    assert [f.index for labels in [*released, rest] for f in labels] == list(range(10))


def test_outliers_are_voted_down(model):
    released, rest = run(model, [0, 0, 0, 2, 0, 0, 0, 1, 1, 1, 1], window=5)
    labels = [f for part in [*released, rest] for f in part]
    assert [f.label for f in labels] == ["corridor"] * 7 + ["kitchen"] * 4
    assert labels[3].raw_label == "office"
    assert all(0 < f.score <= 1 for f in labels)


def test_the_vote_is_a_brute_force_majority(model):
    words = np.random.default_rng(0).integers(0, 3, 60)
    released, rest = run(model, words, window=7)
    labels = [f for part in [*released, rest] for f in part]
    assert len(labels) == 60
    for i, f in enumerate(labels):
        votes = np.bincount(words[max(0, i - 3) : i + 4], minlength=3)
        assert votes[f.label_id - 1] == votes.max()


def test_short_sequences_and_windows_of_one(model):
    released, rest = run(model, [2, 0], window=9)
    assert released == [[], []]
    assert len(rest) == 2
    released, rest = run(model, [2, 0], window=1)
    assert [f.label for labels in released for f in labels] == ["office", "corridor"]
    assert rest == []


def test_featureless_frames_abstain(model):
    labeller = PlaceLabeller(model, LabellerSettings(window=3))
    items = (frame(0, 2), frame(1, n=0), frame(2, 2))
    labels = [f for item in items for f in labeller.process(item)] + labeller.finish()
    assert [f.label for f in labels] == ["office"] * 3
    assert labels[1].raw_label == "unknown"


def test_only_featureless_frames_are_unknown(model):
    labeller = PlaceLabeller(model, LabellerSettings(window=3))
    (label,) = labeller.process(frame(0, n=0)) + labeller.finish()
    assert (label.label, label.label_id, label.score) == ("unknown", 0, 0.0)


def test_without_a_model_everything_is_unknown_at_once():
    labeller = PlaceLabeller(None, LabellerSettings())
    (label,) = labeller.process(frame(0))
    assert (label.label, label.label_id, label.score) == ("unknown", 0, 0.0)
    assert labeller.finish() == []


def test_the_window_is_odd():
    with pytest.raises(ValidationError, match="odd"):
        LabellerSettings(window=8)


def looked_at(index, word, is_looked_at=True, x=None):
    x = 0.1 * index if x is None else x
    item = frame(index, word, x)
    if not is_looked_at:
        item = FrameInput(index, item.stamp_s, position_world=item.position_world)
    return item


def labelled(model, items, **settings):
    labeller = PlaceLabeller(model, LabellerSettings(**({"method": "vote"} | settings)))
    parts = [labeller.process(item) for item in items]
    return parts, [f for part in parts for f in part] + labeller.finish()


def test_frames_without_features_take_the_label_around_them(model):
    words = [0] * 30 + [1] * 30
    items = [looked_at(i, word, i % 6 == 0) for i, word in enumerate(words)]
    parts, labels = labelled(model, items, window=13, min_voters=3)
    assert [f.index for f in labels] == list(range(60))
    found = [f.label for f in labels]
    assert found[:27] == ["corridor"] * 27
    assert found[33:] == ["kitchen"] * 27
    assert [f.raw_label for f in labels[:3]] == ["corridor", "unknown", "unknown"]
    assert all(len(f.signature) for f in labels)
    # As late as half a window, and as the first keyframe after it.
    assert 6 <= next(i for i, part in enumerate(parts) if part) <= 12


def test_the_vote_does_not_depend_on_the_frame_rate(model):
    """The same keyframes with three or with thirty frames between them."""
    words = [0, 0, 2, 0, 0, 1, 1, 0, 1, 1]
    at = {}
    for between in (3, 30):
        items = [looked_at(i, words[i // between], i % between == 0) for i in range(10 * between)]
        _, labels = labelled(model, items, window=9, min_voters=5, max_delay=999)
        at[between] = [labels[i * between].label for i in range(10)]
    assert at[3] == at[30]
    assert (at[3][:4], at[3][6:]) == (["corridor"] * 4, ["kitchen"] * 4)


def test_a_camera_that_stands_still_gets_its_labels_in_the_end(model):
    items = [looked_at(i, 0, i < 3) for i in range(50)]
    parts, labels = labelled(model, items, window=5, min_voters=5, max_delay=20)
    assert [len(part) for part in parts[25:]] == [1] * 25
    assert {f.label for f in labels} == {"corridor"}


def test_voters_are_named(model):
    items = [looked_at(i, w) for i, w in enumerate([0, 0, 2, 0, 0])]
    _, labels = labelled(model, items, window=5, min_voters=1)
    assert labels[2].voters == (0, 1, 3, 4)
    assert labels[2].probabilities[labels[2].label_id] == labels[2].score


def test_the_filter_puts_a_lone_mistake_right(model):
    words = [0] * 8 + [2] + [0] * 8 + [1] * 10
    items = [looked_at(i, w, x=0.5 * i) for i, w in enumerate(words)]
    _, labels = labelled(model, items, window=7, min_voters=3, method="filter", change_m=50)
    assert [f.label for f in labels] == ["corridor"] * 17 + ["kitchen"] * 10
    assert all(0 < f.score <= 1 for f in labels)


def test_without_poses_a_change_is_found_as_soon_at_any_frame_rate(model):
    """Thirty images a second of one view say no more than a few of them."""
    late = {}
    for rate in (1, 10):
        words = [0] * 12 * rate + [1] * 12 * rate
        items = [frame(i, word) for i, word in enumerate(words)]
        settings = {"method": "filter", "window": 9 * rate, "min_voters": 5}
        settings["window"] += settings["window"] % 2 == 0
        _, labels = labelled(model, items, **settings)
        found = [f.label for f in labels]
        late[rate] = found.index("kitchen") / rate - 12
        assert set(found) == {"corridor", "kitchen"}
    assert abs(late[1]) <= 1
    assert abs(late[10]) <= 1


def test_memory_stays_bounded(model):
    labeller = PlaceLabeller(model, LabellerSettings(window=7, min_voters=3))
    for i in range(300):
        labeller.process(looked_at(i, i % 3))
    assert len(labeller._looks) <= 12
    assert len(labeller._waiting) <= 4
