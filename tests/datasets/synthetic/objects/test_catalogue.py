"""Every model of furniture: it builds, is of a sensible size, and differs from seed to seed."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from roomgraph.datasets.synthetic.furnishing import furnish, programmes
from roomgraph.datasets.synthetic.furnishing.piece import make_piece
from roomgraph.datasets.synthetic.objects.catalogue import build_model, models, package_of
from roomgraph.datasets.synthetic.objects.look import draw_look
from roomgraph.datasets.synthetic.rendering.mesh import Surfaces
from roomgraph.datasets.synthetic.rendering.stand import Stand

pytestmark = pytest.mark.slow

SEEDS = (0, 1, 2)
MOST_M, MOST_QUADS, LEAST_VARIED = 5.0, 2000, 0.8


def _piece(name, seed):
    # The same look for all seeds: what differs then is the model's own doing.
    return make_piece(name, np.random.default_rng(seed), draw_look(np.random.default_rng(9)))


def _same(one, other):
    pairs = list(itertools.zip_longest(one.surfaces.quads, other.surfaces.quads))
    return all(
        a is not None
        and b is not None
        and np.array_equal(a.corners, b.corners)
        and np.array_equal(a.material.image, b.material.image)
        and a.window == b.window
        for a, b in pairs
    )


@pytest.fixture(scope="module")
def pieces():
    return {name: [_piece(name, seed) for seed in SEEDS] for name in models()}


def test_no_name_is_there_twice():
    assert len(models()) == len(set(models())) > 100


@pytest.mark.parametrize("name", models())
def test_a_model_has_things_and_is_of_a_sensible_size(name, pieces):
    for piece in pieces[name]:
        assert piece.surfaces.things, "nothing in it has a name"
        assert 0 < len(piece.surfaces.quads) < MOST_QUADS
        assert float(np.ptp([piece.low, piece.high], axis=0).max()) <= MOST_M
        assert piece.low[2] >= -0.01, "it reaches below the floor"
        for quad in piece.surfaces.quads:
            assert np.isfinite(quad.corners).all()


@pytest.mark.parametrize("name", models())
def test_the_same_seed_gives_the_same_piece(name, pieces):
    again = _piece(name, SEEDS[0])
    assert _same(pieces[name][0], again)
    assert pieces[name][0].surfaces.things == again.surfaces.things


def test_another_seed_gives_another_piece(pieces):
    alike = [name for name, (one, *others) in pieces.items() if any(_same(one, o) for o in others)]
    assert len(alike) <= (1 - LEAST_VARIED) * len(pieces), alike


def test_an_unknown_name_is_told():
    stand = Stand(Surfaces(np.random.default_rng(0)), (0.0, 0.0, 0.0), 0.0)
    look = draw_look(np.random.default_rng(0))
    with pytest.raises(ValueError, match="no_such_model"):
        build_model("no_such_model", stand, look)
    with pytest.raises(ValueError, match="no_such_model"):
        package_of("no_such_model")


def test_the_programmes_name_models_that_are_there():
    items = [item for items in programmes.PROGRAMMES.values() for item in items]
    used = {item.model for item in items} | {item.near[1] for item in items if item.near}
    used |= programmes.FIXED | programmes.HEAVY | programmes.REPLACED
    used |= {*programmes.LEFT, *programmes.SMALL, *furnish.SEATS}
    assert sorted(used - set(models())) == []


def test_a_model_tells_its_package():
    assert package_of("sofa") == "home"
    assert {package_of(name) for name in models()} == {
        "bathroom", "decor", "home", "kitchen", "laboratory", "office", "service",
    }  # fmt: skip
