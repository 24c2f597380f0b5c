import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from roomgraph.datasets import se3

steps = arrays(np.float64, 6, elements=st.floats(-1.5, 1.5))


def test_inverse_undoes_each_of_many(random_poses):
    assert np.allclose(se3.inverse(random_poses) @ random_poses, np.eye(4))
    assert np.allclose(se3.inverse(random_poses[3]) @ random_poses[3], np.eye(4))


def test_quaternions_round_trip_for_more_than_one_pose(random_poses):
    back = se3.from_quaternion(se3.to_quaternion(random_poses), random_poses[:, :3, 3])
    assert np.allclose(back, random_poses)


def test_quaternions_are_xyzw():
    quarter_turn = se3.from_quaternion([[0, 0, np.sqrt(0.5), np.sqrt(0.5)]], [[1, 2, 3]])[0]
    assert np.allclose(se3.transform(quarter_turn, np.array([[1.0, 0, 0]])), [[1, 3, 3]])


def test_orthonormal_mends_what_rounding_has_bent(random_poses, rng):
    bent = random_poses[0] + np.pad(1e-4 * rng.normal(size=(3, 3)), ((0, 1), (0, 1)))
    mended = se3.orthonormal(bent)
    assert np.allclose(mended[:3, :3] @ mended[:3, :3].T, np.eye(3), atol=1e-12)
    assert np.allclose(mended, random_poses[0], atol=1e-3)


def test_transform_is_the_matrix_product(random_poses, rng):
    points = rng.normal(size=(9, 3))
    expected = (random_poses[0] @ np.column_stack([points, np.ones(9)]).T).T[:, :3]
    assert np.allclose(se3.transform(random_poses[0], points), expected)


@given(steps)
def test_logarithm_undoes_exponential(step):
    assert np.allclose(se3.logarithm(se3.exponential(step)), step, atol=1e-9)


@given(steps)
def test_exponential_is_rigid(step):
    R = se3.exponential(step)[:3, :3]
    assert np.allclose(R @ R.T, np.eye(3))
    assert np.isclose(np.linalg.det(R), 1)
    assert np.isclose(se3.rotation_angle(se3.exponential(step)), np.linalg.norm(step[:3]))


def test_hat_is_the_cross_product(rng):
    a, b = rng.normal(size=(2, 5, 3))
    assert np.allclose((se3.hat(a) @ b[..., None])[..., 0], np.cross(a, b))


@given(steps)
def test_adjoint_carries_steps_through_a_motion(step):
    T = se3.exponential(np.array([0.3, -0.2, 0.5, 1.0, -2.0, 0.5]))
    small = 1e-6 * step
    carried = se3.exponential(se3.adjoint(T) @ small) @ T
    assert np.allclose(carried, T @ se3.exponential(small), atol=1e-10)
