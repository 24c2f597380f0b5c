"""Rigid motions as (4, 4) matrices, and quaternions in xyzw order."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial.transform import Rotation

FloatArray = NDArray[np.float64]


def pose(R: ArrayLike | None = None, t: ArrayLike | None = None) -> FloatArray:
    """Return the (4, 4) rigid motion with rotation `R` (3, 3) and translation `t` (3,), metres."""
    T = np.eye(4)
    if R is not None:
        T[:3, :3] = R
    if t is not None:
        T[:3, 3] = t
    return T


def inverse(T: FloatArray) -> FloatArray:
    """Invert rigid motions (..., 4, 4)."""
    result = np.zeros_like(T)
    R_transposed = np.swapaxes(T[..., :3, :3], -1, -2)
    result[..., :3, :3] = R_transposed
    result[..., :3, 3] = -(R_transposed @ T[..., :3, 3:])[..., 0]
    result[..., 3, 3] = 1.0
    return result


def orthonormal(T: FloatArray) -> FloatArray:
    """Return the rigid motion nearest to `T` (4, 4), which rounding has bent."""
    U, _, Vt = np.linalg.svd(T[:3, :3])
    return pose(U @ Vt, T[:3, 3])


def transform(T: FloatArray, points: NDArray[np.floating]) -> FloatArray:
    """Move points (N, 3) by the rigid motion `T` (4, 4)."""
    return np.asarray(points @ T[:3, :3].T + T[:3, 3], dtype=np.float64)


def hat(w: FloatArray) -> FloatArray:
    """Return the skew-symmetric matrices (..., 3, 3) of vectors (..., 3)."""
    result = np.zeros((*w.shape, 3))
    result[..., 0, 1], result[..., 0, 2] = -w[..., 2], w[..., 1]
    result[..., 1, 0], result[..., 1, 2] = w[..., 2], -w[..., 0]
    result[..., 2, 0], result[..., 2, 1] = -w[..., 1], w[..., 0]
    return result


def exponential(xi: FloatArray) -> FloatArray:
    """Return the motion (4, 4) of a small step `xi` (6,): rotation vector, then translation.

    The translation is taken as it is (the pseudo-exponential of Blanco, 2010, section 9),
    which agrees with the exponential of SE(3) to first order.
    """
    return pose(cv2.Rodrigues(xi[:3])[0], xi[3:])


def logarithm(T: FloatArray) -> FloatArray:
    """Return the step (6,) that `exponential` turns into `T` (4, 4)."""
    sine, cosine = _sine_and_cosine(T)
    length = float(np.linalg.norm(sine))
    if cosine < 0 and length < 1e-3:
        # Near half a turn the axis is not to be had from the sine.
        return np.concatenate([Rotation.from_matrix(T[:3, :3]).as_rotvec(), T[:3, 3]])
    scale = np.arctan2(length, cosine) / length if length > 0 else 1.0
    return np.concatenate([scale * sine, T[:3, 3]])


def adjoint(T: FloatArray) -> FloatArray:
    """Return the (6, 6) matrix that carries a left step of `T`'s source frame to its target's."""
    R = T[:3, :3]
    result = np.zeros((6, 6))
    result[:3, :3] = result[3:, 3:] = R
    result[3:, :3] = hat(T[:3, 3]) @ R
    return result


def rotation_angle(T: FloatArray) -> float:
    """Return the angle of the rotation of `T` (4, 4), in radians, in [0, pi]."""
    sine, cosine = _sine_and_cosine(T)
    return float(np.arctan2(np.linalg.norm(sine), cosine))


def _sine_and_cosine(T: FloatArray) -> tuple[FloatArray, float]:
    """Return the axis (3,) of a rotation times the sine of its angle, and the cosine."""
    R = T[:3, :3]
    sine = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    return sine, float(R[0, 0] + R[1, 1] + R[2, 2] - 1) / 2


def from_quaternion(xyzw: ArrayLike, t: ArrayLike) -> FloatArray:
    """Return motions (N, 4, 4) from quaternions (N, 4) in xyzw order and translations (N, 3)."""
    quaternions = np.atleast_2d(np.asarray(xyzw, dtype=np.float64))
    T = np.tile(np.eye(4), (len(quaternions), 1, 1))
    T[:, :3, :3] = Rotation.from_quat(quaternions).as_matrix()
    T[:, :3, 3] = np.atleast_2d(np.asarray(t, dtype=np.float64))
    return T


def to_quaternion(T: FloatArray) -> FloatArray:
    """Return the rotations of motions (N, 4, 4) as unit quaternions (N, 4), xyzw, w >= 0."""
    return np.asarray(Rotation.from_matrix(T[..., :3, :3]).as_quat(canonical=True))
