import numpy as np

from roomgraph.semantics.graph.instances import InstanceSettings, Observation, PlaceNames
from tests.semantics.helpers import view


class Walk:
    """Asks for the place of one node after the other, all of the same label."""

    def __init__(self):
        self.names = PlaceNames(InstanceSettings(min_difference=0.8))
        self.observations, self.stays = [], []

    def node(self, x, signature, follows_last=False):
        here = Observation(np.array([x, 0.0, 0.0]), signature)
        stay = self.names.assign("office", here, self.observations, self.stays, follows_last)
        self.observations.append(here)
        self.stays.append(stay)
        return self.names.name(stay)

    @property
    def places(self):
        return [self.names.name(stay) for stay in self.stays]


def mix(a, b, share):
    """A unit signature between two views; its distance to `a` grows with `share`."""
    signature = (1 - share) * view(a) + share * view(b)
    return signature / np.linalg.norm(signature)


def test_the_first_place_is_number_one():
    assert Walk().node(0, view(0)) == "office1"


def test_far_and_different_is_another_place():
    walk = Walk()
    walk.node(0, view(0))
    assert walk.node(5.1, view(1)) == "office2"


def test_far_and_similar_or_near_and_different_is_the_same():
    walk = Walk()
    walk.node(0, view(0))
    assert walk.node(20, mix(0, 1, 0.4)) == "office1"
    walk = Walk()
    walk.node(0, view(0))
    assert walk.node(4.9, view(1)) == "office1"


def test_it_has_to_differ_from_every_memory():
    walk = Walk()
    for x, k in ((0, 0), (1, 1), (2, 2)):
        walk.node(x, view(k), follows_last=x > 0)
    assert walk.node(20, view(1)) == "office1"


def test_the_nearest_place_wins_within_the_distance_else_the_most_similar():
    def ask(x, k):
        walk = Walk()
        walk.node(0, view(0))
        walk.node(8, view(1))
        return walk.node(x, view(k))

    assert ask(4.5, 0) == "office2"
    assert ask(3.5, 1) == "office1"
    assert ask(30, 0) == "office1"
    assert ask(30, 1) == "office2"
    assert ask(30, 2) == "office3"


def test_a_stay_is_renamed_from_its_beginning_once_it_is_clear():
    walk = Walk()
    walk.node(0, view(0))
    walk.node(1, view(1), follows_last=True)
    assert walk.node(8, mix(0, 2, 0.4)) == "office1"
    assert walk.node(9, mix(0, 2, 0.45), follows_last=True) == "office1"
    assert walk.node(10, view(2), follows_last=True) == "office2"
    assert walk.node(11, view(0), follows_last=True) == "office2"
    assert walk.places == ["office1"] * 2 + ["office2"] * 4


def test_a_stay_that_comes_near_a_known_place_is_settled_as_that():
    walk = Walk()
    walk.node(0, view(0))
    walk.node(7, mix(0, 2, 0.4))
    walk.node(4.5, mix(0, 2, 0.4), follows_last=True)
    assert walk.node(7, view(2), follows_last=True) == "office1"
    assert set(walk.places) == {"office1"}


def test_a_long_room_hangs_together():
    walk = Walk()
    for i in range(15):
        walk.node(float(i), view(i), follows_last=i > 0)
    assert set(walk.places) == {"office1"}


def test_a_stay_goes_on_after_a_wrong_label_in_between():
    walk = Walk()
    walk.node(0, view(0))
    walk.node(8, mix(0, 2, 0.4))
    assert walk.node(10, view(2), follows_last=False) == "office2"
    assert walk.places == ["office1", "office2", "office2"]


def test_by_default_rooms_that_look_somewhat_alike_are_told_apart_by_distance():
    walk = Walk()
    walk.names = PlaceNames(InstanceSettings())
    assert walk.node(0, view(0)) == "office1"
    alike = mix(0, 2, 0.4)
    assert 0.4 < float(np.linalg.norm(alike - view(0))) < 0.8
    assert walk.node(8, alike) == "office2"
    assert walk.node(16, alike) == "office2"
