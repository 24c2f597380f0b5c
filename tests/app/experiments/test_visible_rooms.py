import cv2
import numpy as np
import pytest

from roomgraph.app.experiments.visible_rooms import (
    doorway_distances,
    stretches_along,
    visible_rooms,
)
from roomgraph.app.experiments.walks import Walk
from roomgraph.datasets.readers.registry import open_sequence
from roomgraph.semantics.recognition.examples import folder_examples, sequence_examples


@pytest.fixture(scope="module")
def walk(rendered_walk):
    return Walk("building", "day", sequence_examples(open_sequence(rendered_walk)))


def test_what_the_images_of_a_walk_show(walk):
    found = visible_rooms([walk], walk.examples)
    own = np.array([visible_room.own_share for visible_room in found])
    same = np.array([s.room == e.place for s, e in zip(found, walk.examples, strict=True)])
    assert ((own >= 0) & (own <= 1)).all()
    # Most of an image that shows more of its own room than of all others together is of that room.
    assert same[own > 0.5].all()
    assert not same[own < 0.01].any()
    assert same.mean() > 0.5


def test_ways_to_doorways_fall_to_nothing_where_the_room_changes(walk):
    ways = doorway_distances([walk], walk.examples)
    groups = [example.group for example in walk.examples]
    changes = [i for i in range(1, len(groups)) if groups[i] != groups[i - 1]]
    assert changes
    assert all(min(ways[i - 1], ways[i]) < 0.2 for i in changes)
    assert ways.max() > 0.5


def test_of_photographs_nothing_of_this_is_known(tmp_path):
    (tmp_path / "office").mkdir()
    cv2.imwrite(str(tmp_path / "office" / "a.png"), np.zeros((40, 60, 3), dtype=np.uint8))
    walk = Walk("photos", "photos", folder_examples(tmp_path))
    assert visible_rooms([walk], walk.examples) == []
    assert len(doorway_distances([walk], walk.examples)) == 0


def test_every_visit_has_two_stretches_at_least():
    visits = np.array(["a"] * 3 + ["b"] * 20)
    order, stretches = stretches_along(np.zeros(23), visits)
    np.testing.assert_array_equal(order, np.arange(23))
    assert len(set(stretches[:3])) == 2
    assert not set(stretches[:3]) & set(stretches[3:])
    assert (np.diff(stretches) >= 0).all()
