import numpy as np
import pytest
from scipy.spatial.distance import cdist

from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.frame import Frame
from roomgraph.slam.errors import SlamError
from roomgraph.slam.features.extraction import FeatureExtractor, Features, FeatureSettings, root
from roomgraph.slam.features.matching import match, match_near, near, squared_distances
from roomgraph.slam.features.view import View, depth_at
from roomgraph.slam.geometry.range_image import without_edges
from roomgraph.slam.relocalisation.word_index import WordIndex, WordIndexSettings


def test_distances_agree_with_scipy(rng):
    a, b = rng.random((30, 128), np.float32), rng.random((20, 128), np.float32)
    assert np.allclose(squared_distances(a, b), cdist(a, b, "sqeuclidean"), rtol=1e-4, atol=1e-4)


def test_hamming_distances_of_binary_descriptors():
    a = np.array([[0b1111, 0], [0, 1]], np.uint8)
    b = np.array([[0b0001, 0]], np.uint8)
    assert squared_distances(a, b).tolist() == [[9], [4]]


def test_matching_finds_a_shuffle(rng):
    rows = rng.random((50, 128), np.float32)
    order = rng.permutation(50)
    pairs = match(rows, rows[order] + 0.01 * rng.random((50, 128), np.float32), 0.8)
    assert len(pairs) == 50
    assert np.array_equal(order[pairs[:, 1]], pairs[:, 0])


def test_ratio_test_refuses_what_is_ambiguous(rng):
    rows = rng.random((1, 128), np.float32)
    twins = np.repeat(rows, 2, axis=0) + 0.001
    assert len(match(rows, twins, 0.8)) == 0
    predicted, pixels = np.zeros((1, 2)), np.array([[0.0, 0.0], [90.0, 0.0]])
    assert match_near(rows, twins, predicted, pixels, 10.0, 0.8).tolist() == [[0, 0]]


@pytest.mark.parametrize("radius", [2.0, 15.0, 500.0])
def test_guided_matching_in_strips_misses_nothing(rng, radius):
    columns, pixels = rng.random((200, 32), np.float32), rng.uniform(0, (320, 240), (200, 2))
    order = rng.integers(0, 200, 300)
    rows = columns[order] + 0.05 * rng.random((300, 32), np.float32)
    predicted = pixels[order] + rng.normal(0, 4, (300, 2))
    found = match_near(rows, columns, predicted, pixels, radius, 0.8)
    distance = cdist(rows, columns)
    gap = np.abs(predicted[:, None] - pixels).max(axis=2)
    distance[gap >= radius] = np.inf
    nearest, second = np.argsort(distance, axis=1)[:, :2].T
    every = np.arange(300)
    clear = distance[every, nearest] < 0.8 * distance[every, second]
    best = {}
    for row in np.flatnonzero(clear & np.isfinite(distance[every, nearest])):
        column = int(nearest[row])
        if column not in best or distance[row, column] < distance[best[column], column]:
            best[column] = int(row)
    assert sorted([row, column] for column, row in best.items()) == found.tolist()


def test_a_column_is_taken_by_its_nearest_row_only(rng):
    column = rng.random((2, 128), np.float32)
    rows = np.vstack([column[0] + 0.02, column[0] + 0.01]).astype(np.float32)
    assert match(rows, column, 0.8).tolist() == [[1, 0]]


def test_nothing_matches_nothing(rng):
    some = rng.random((3, 128), np.float32)
    assert match(some[:0], some, 0.8).shape == (0, 2)
    assert match(some, some[:0], 0.8).shape == (0, 2)
    nowhere, far = np.zeros((3, 2)), np.full((3, 2), 99.0)
    assert match_near(some, some, nowhere, far, 5.0, 0.8).shape == (0, 2)


def test_near_is_a_box():
    allowed = near(np.array([[10.0, 10.0]]), np.array([[12.0, 9.0], [14.0, 10.0]]), 3)
    assert allowed.tolist() == [[True, False]]


def _chessboard(rng, size=(240, 320)):
    image = rng.integers(0, 255, (size[0] // 16, size[1] // 16), dtype=np.uint8)
    return np.repeat(np.kron(image, np.ones((16, 16), np.uint8))[..., None], 3, axis=2)


@pytest.mark.parametrize("detector", ["sift", "rootsift", "orb"])
def test_features_follow_a_shift(rng, detector):
    image = _chessboard(rng)
    extractor = FeatureExtractor(FeatureSettings(detector=detector, working_width=320))
    first = extractor.extract_image(image[:, 24:])
    second = extractor.extract_image(image[:, :-24])
    pairs = match(first.descriptors, second.descriptors, 0.8)
    shift = second.pixels[pairs[:, 1]] - first.pixels[pairs[:, 0]]
    assert len(pairs) > 20
    assert np.allclose(np.median(shift, axis=0), (24, 0), atol=0.3)


def test_halving_keeps_positions(rng):
    image = np.kron(_chessboard(rng)[..., 0], np.ones((2, 2), np.uint8))
    whole = FeatureExtractor(FeatureSettings(working_width=640)).extract_image(image)
    half = FeatureExtractor(FeatureSettings(working_width=320)).extract_image(image)
    distance = cdist(half.pixels, whole.pixels).min(axis=1)
    offset = whole.pixels[cdist(half.pixels, whole.pixels).argmin(axis=1)] - half.pixels
    assert (distance < 1.0).mean() > 0.3
    assert np.abs(np.median(offset[distance < 2], axis=0)).max() < 0.3


def test_blank_image_has_no_features():
    for detector in ("sift", "orb"):
        extractor = FeatureExtractor(FeatureSettings(detector=detector))
        assert len(extractor.extract_image(np.full((240, 320, 3), 127, np.uint8))) == 0


def test_surf_missing_is_said():
    with pytest.raises(SlamError, match="this build of OpenCV has no SURF"):
        FeatureExtractor(FeatureSettings(detector="surf"))


def test_rootsift_compares_roots(rng):
    sift = rng.integers(0, 200, (4, 128)).astype(np.float32)
    expected = np.sqrt(sift / sift.sum(axis=1, keepdims=True))
    assert np.allclose(root(sift) / 512, expected, rtol=1e-5)
    assert np.allclose(np.linalg.norm(root(sift), axis=1), 512, rtol=1e-5)


def test_depth_is_refused_in_holes_and_on_edges():
    depth = np.full((20, 20), 2.0, np.float32)
    depth[:, 10:] = 3.0
    depth[0:6, 0:6] = 0
    found = depth_at(depth, np.array([[15.0, 15.0], [10.0, 10.0], [2.0, 2.0], [5.0, 15.0]]))
    assert found.tolist() == [3.0, 0.0, 0.0, 2.0]
    cleaned = without_edges(depth)
    assert (cleaned[10, 8:12] == (2, 0, 0, 3)).all()


def test_view_has_points_where_there_is_depth(rng):
    camera = Intrinsics(320, 240, 260, 260, 159.5, 119.5)
    depth = np.full((240, 320), 2.0, np.float32)
    depth[:, :100] = 0
    depth[:, 220:] = 9.0
    frame = Frame(0, 0.0, _chessboard(rng), depth, camera)
    view = View(frame, FeatureExtractor(FeatureSettings()), max_depth_m=8.0)
    inner = (view.features.pixels[:, 0] > 105) & (view.features.pixels[:, 0] < 215)
    assert np.array_equal(view.has_point & inner, inner)
    assert not view.has_point[view.features.pixels[:, 0] < 95].any()
    assert not view.has_point[view.features.pixels[:, 0] > 225].any()
    assert np.allclose(camera.project(view.points_camera[inner]), view.features.pixels[inner])


def test_word_index_ranks_the_same_place_first(rng):
    index = WordIndex(WordIndexSettings())
    places = [root(rng.integers(0, 200, (80, 128)).astype(np.float32) ** 2) for _ in range(6)]
    for keyframe, descriptors in enumerate(places):
        index.add(keyframe, index.words_of(descriptors))
    again = places[2][:50] + rng.normal(0, 2, (50, 128)).astype(np.float32)
    ranked = index.rank(index.words_of(again), before=6)
    assert ranked[0][0] == 2
    assert ranked[0][1] > 3 * (ranked[1][1] if len(ranked) > 1 else 0)
    assert all(k < 2 for k, _ in index.rank(index.words_of(again), before=2))
    assert index.words_of(Features.none().descriptors).shape == (0,)
