import time

import cv2
import numpy as np
import pytest
from pydantic import ValidationError
from threadpoolctl import threadpool_limits

from roomgraph.semantics.descriptors.dense import (
    DenseDescriptors,
    DenseSettings,
    describe_small,
    small_grey,
)
from roomgraph.semantics.descriptors.fisher import FisherSettings
from roomgraph.semantics.descriptors.fisher_encoder import FisherEncoder

SETTINGS = DenseSettings(side=96, scales=2, step=6)


def describe_densely(image, settings):
    return describe_small(small_grey(image, settings), settings)


def stripes(angle, size=(120, 160), period=9.0):
    y, x = np.mgrid[: size[0], : size[1]]
    wave = np.sin(2 * np.pi * (x * np.cos(angle) + y * np.sin(angle)) / period)
    return np.repeat((127 + 100 * wave).astype(np.uint8)[..., None], 3, axis=2)


def test_descriptors_are_roots_of_shares_within_the_image():
    found = describe_densely(stripes(0.3), SETTINGS)
    assert found.descriptors.shape == (len(found), 128)
    assert (found.descriptors >= 0).all()
    length = np.linalg.norm(found.descriptors, axis=1)
    assert (length < 1).all()
    assert np.median(length) > 0.7
    assert (np.abs(found.positions) < 0.5).all()
    np.testing.assert_allclose(found.positions.mean(axis=0), 0, atol=0.05)


def test_orientation_is_that_of_the_gradient():
    for angle in (0.0, np.pi / 4, np.pi / 2):
        found = describe_densely(stripes(angle), SETTINGS).descriptors
        share = (found.reshape(-1, 16, 8) ** 2).sum(axis=(0, 1))
        # Stripes rise and fall: the gradient points both ways.
        expected = round(angle / (np.pi / 4))
        assert set(np.argsort(share)[-2:]) == {expected, expected + 4}


def test_brightness_does_not_count_and_flat_images_say_nothing():
    image = stripes(0.3)
    bright = describe_densely(image // 2 + 100, SETTINGS).descriptors
    assert np.abs(bright - describe_densely(image // 2, SETTINGS).descriptors).max() < 0.02
    assert describe_densely(np.full((60, 80, 3), 90, np.uint8), SETTINGS).descriptors.max() < 1e-3


def test_any_shape_and_grey_images():
    for size in ((40, 300), (300, 40), (20, 20), (480, 640)):
        image = stripes(0.2, size)
        found = describe_densely(image, SETTINGS)
        assert len(found) > 0
        grey = describe_densely(image[..., 0], SETTINGS)
        np.testing.assert_allclose(grey.descriptors, found.descriptors, atol=0.02)


def test_settings_are_checked():
    with pytest.raises(ValidationError):
        DenseSettings(contrast=0)


@pytest.fixture(scope="module")
def encoder():
    rng = np.random.default_rng(0)
    images = [describe_densely(stripes(a), SETTINGS) for a in rng.uniform(0, np.pi, 20)]
    sample = DenseDescriptors(
        np.vstack([i.descriptors for i in images]), np.vstack([i.positions for i in images])
    )
    return FisherEncoder.fit(sample, SETTINGS, 6, 5, 2, np.random.default_rng(1))


def test_the_fisher_vector_is_the_gradient_of_the_likelihood(encoder):
    """Against numerical derivatives of the mixture's log likelihood."""
    image = describe_densely(stripes(0.7), SETTINGS)
    points = encoder.project(image).astype(np.float64)
    a = {name: array.astype(np.float64) for name, array in encoder.arrays.items()}

    def likelihood(means, deviations):
        z = (points[:, None] - means) / deviations
        log = np.log(a["weights"]) - np.log(deviations).sum(axis=1) - 0.5 * (z**2).sum(axis=2)
        return np.logaddexp.reduce(log, axis=1).mean()

    means, deviations, h = a["means"], np.sqrt(a["variances"]), 1e-4
    vector = np.zeros((2, *means.shape))
    for index in np.ndindex(*means.shape):
        for part in (0, 1):
            step = np.zeros_like(means)
            step[index] = h * deviations[index]
            up, down = (
                likelihood(means + s * step, deviations) if part == 0
                else likelihood(means, deviations + s * step)
                for s in (1, -1)
            )  # fmt: skip
            # The Fisher information of a mean is w / sigma^2, that of a deviation 2 w / sigma^2.
            scale = np.sqrt(a["weights"][index[0]] * (1 + part))
            vector[(part, *index)] = (up - down) / (2 * h) / scale
    vector = np.sign(vector) * np.sqrt(np.abs(vector))
    expected = vector.ravel() / np.linalg.norm(vector)
    found = encoder.encode(image)
    assert found.shape == (encoder.length,)
    np.testing.assert_allclose(found, expected, atol=0.01)


def test_posteriors_are_shares_without_numbers_next_to_nothing(encoder):
    found = encoder.posteriors(encoder.project(describe_densely(stripes(0.7), SETTINGS)))
    np.testing.assert_allclose(found.sum(axis=1), 1, atol=1e-5)
    assert found[found > 0].min() > 1e-6
    assert (found == 0).any()


def test_like_images_are_near(encoder):
    a, b, c = (encoder.encode(describe_densely(stripes(x), SETTINGS)) for x in (0.5, 0.55, 2.0))
    assert a @ b > 0.5 > a @ c


def test_flat_images_have_no_vector(encoder):
    flat = describe_densely(np.full((60, 80, 3), 90, np.uint8), SETTINGS)
    assert not encoder.encode(flat).any()


@pytest.mark.slow
def test_is_cheap():
    """An image of 640x480 by the default settings: 15 ms on a core that is a few years old."""
    rng = np.random.default_rng(0)
    grain = cv2.GaussianBlur(rng.normal(0, 1, (480, 640)), (0, 0), 4)
    image = np.repeat(np.clip(127 + 600 * grain, 0, 255).astype(np.uint8)[..., None], 3, axis=2)
    settings = FisherSettings()
    sample = describe_densely(image, settings.dense)
    encoder = FisherEncoder.fit(
        sample, settings.dense, settings.n_words, settings.n_components, 1, rng, 2
    )
    times = []
    with threadpool_limits(1, user_api="blas"):
        for _ in range(20):
            start = time.process_time()
            encoder.encode(describe_densely(image, settings.dense))
            times.append(time.process_time() - start)
    assert min(times) < 0.02


def test_position_counts(encoder):
    image = describe_densely(stripes(0.5), SETTINGS)
    moved = DenseDescriptors(image.descriptors, image.positions * 0.2)
    assert encoder.encode(moved) @ encoder.encode(image) < 0.95
