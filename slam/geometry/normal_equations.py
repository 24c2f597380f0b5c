"""The normal equations of motions and bundles, compiled.

What calls each other is in this file together: see `slam.compiled`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roomgraph.slam.geometry.compiled import compiled

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]

# Added to the diagonals of systems, so that directions that nothing measures stay as they are.
HOLD = 1e-6
# Nothing is seen from nearer than this, metres; a projection from there means nothing.
NEAREST_M = 1e-3


@compiled
def _observe(
    T: FloatArray,
    points: FloatArray,
    i: int,
    pixels: FloatArray,
    depths: FloatArray,
    n: int,
    K: FloatArray,
    residual: FloatArray,
    J: FloatArray,
) -> bool:
    """Compare the i-th point, moved by `T`, with the n-th pixel and depth that a camera measured.

    Fills `residual` (3,), two pixels and an inverse depth, which is 0 where the measured one is
    NaN, and `J` (3, 6), its derivatives by a left step of the motion. Returns whether the point
    lies before the camera; nothing is filled in unless it does.
    """
    px, py, pz = points[i, 0], points[i, 1], points[i, 2]
    x = T[0, 0] * px + T[0, 1] * py + T[0, 2] * pz + T[0, 3]
    y = T[1, 0] * px + T[1, 1] * py + T[1, 2] * pz + T[1, 3]
    z = T[2, 0] * px + T[2, 1] * py + T[2, 2] * pz + T[2, 3]
    if not z > NEAREST_M:
        return False
    d = 1.0 / z
    u, v = x * d, y * d
    fx, fy = K[0], K[1]
    residual[0] = fx * u + K[2] - pixels[n, 0]
    residual[1] = fy * v + K[3] - pixels[n, 1]
    J[0, 0], J[0, 1], J[0, 2] = -fx * u * v, fx * (1 + u * u), -fx * v
    J[0, 3], J[0, 4], J[0, 5] = fx * d, 0.0, -fx * u * d
    J[1, 0], J[1, 1], J[1, 2] = -fy * (1 + v * v), fy * u * v, fy * u
    J[1, 3], J[1, 4], J[1, 5] = 0.0, fy * d, -fy * v * d
    if np.isfinite(depths[n]):
        residual[2] = d - 1.0 / depths[n]
        J[2, 0], J[2, 1], J[2, 5] = -v * d, u * d, -d * d
    else:
        residual[2] = J[2, 0] = J[2, 1] = J[2, 5] = 0.0
    J[2, 2] = J[2, 3] = J[2, 4] = 0.0
    return True


@compiled
def motion_equations(
    T: FloatArray,
    points: FloatArray,
    spread: FloatArray,
    pixels: FloatArray,
    depths: FloatArray,
    inverse_variance: FloatArray,
    K: FloatArray,
    bound: float,
    power: int,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Sum the normal equations of a motion `T` (4, 4) over correspondences; see `refine`.

    Parameters
    ----------
    points, spread : (N, 3) float64
        In the reference, and their standard deviations along their rays.
    pixels, depths : (N, 2), (N,) float64
        What the camera measured.
    inverse_variance : (N, 3) float64
        Of pixels and inverse depth.
    K : (4,) float64
        fx, fy, cx, cy.
    bound, power : float, int
        The robust kernel: (1 + error / bound) ** -power.

    Returns
    -------
    error, H, g : (N,), (6, 6), (6,) float64
        Squared errors in standard deviations, infinite behind the camera, and the system.
    """
    error = np.full(len(points), np.inf)
    H, g = np.zeros((6, 6)), np.zeros(6)
    residual, J = np.empty(3), np.empty((3, 6))
    along, inverse, scaled, column = np.empty(3), np.empty(3), np.empty(3), np.empty(6)
    for n in range(len(points)):
        if not _observe(T, points, n, pixels, depths, n, K, residual, J):
            continue
        # The inverse covariance is a diagonal less one column times itself (Sherman & Morrison).
        total, shift, squares = 1.0, 0.0, 0.0
        for k in range(3):
            along[k] = 0.0
            for i in range(3):
                moved = T[i, 0] * spread[n, 0] + T[i, 1] * spread[n, 1] + T[i, 2] * spread[n, 2]
                along[k] += J[k, 3 + i] * moved
            inverse[k] = inverse_variance[n, k]
            scaled[k] = inverse[k] * along[k]
            total += scaled[k] * along[k]
            shift += scaled[k] * residual[k]
            squares += inverse[k] * residual[k] ** 2
        share = 1.0 / total
        error[n] = squares - share * shift**2
        weight = 1.0
        for _ in range(power):
            weight /= 1.0 + error[n] / bound
        for i in range(6):
            column[i] = scaled[0] * J[0, i] + scaled[1] * J[1, i] + scaled[2] * J[2, i]
        for i in range(6):
            a, b, c = inverse[0] * J[0, i], inverse[1] * J[1, i], inverse[2] * J[2, i]
            less = share * column[i]
            g[i] += weight * (a * residual[0] + b * residual[1] + c * residual[2] - less * shift)
            for j in range(i + 1):
                H[i, j] += weight * (a * J[0, j] + b * J[1, j] + c * J[2, j] - less * column[j])
    for i in range(6):
        for j in range(i):
            H[j, i] = H[i, j]
    return error, H, g


@compiled
def bundle_errors(
    T: FloatArray,
    landmarks: FloatArray,
    cameras: IntArray,
    seen: IntArray,
    pixels: FloatArray,
    depths: FloatArray,
    inverse_variance: FloatArray,
    K: FloatArray,
) -> FloatArray:
    """Return the squared errors (N,) of observations; see `bundle_equations`."""
    error = np.full(len(cameras), np.inf)
    residual, J = np.empty(3), np.empty((3, 6))
    for n in range(len(cameras)):
        if _observe(T[cameras[n]], landmarks, seen[n], pixels, depths, n, K, residual, J):
            error[n] = 0.0
            for k in range(3):
                error[n] += inverse_variance[n, k] * residual[k] ** 2
    return error


@compiled
def bundle_equations(
    T: FloatArray,
    slots: IntArray,
    free: int,
    landmarks: FloatArray,
    cameras: IntArray,
    seen: IntArray,
    pixels: FloatArray,
    depths: FloatArray,
    inverse_variance: FloatArray,
    K: FloatArray,
    bound: float,
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray]:
    """Sum the normal equations of cameras and landmarks, and eliminate the landmarks.

    Parameters
    ----------
    T : (C, 4, 4) float64
        T_camera_world.
    slots : (C,) int
        Where each camera is among those that may move, -1 for those held; `free` may move.
    landmarks : (L, 3) float64
        In the world.
    cameras, seen : (N,) int
        Which camera sees which landmark; sorted by landmark.
    pixels, depths, inverse_variance : (N, 2), (N,), (N, 3) float64
        What it measured, and how much that counts.
    bound : float
        Squared error at which Geman and McClure's kernel counts a residual by a quarter.

    Returns
    -------
    H, g : (6 free, 6 free), (6 free,) float64
        The system of the cameras alone.
    inverse, gradient : (L, 3, 3), (L, 3) float64
        Inverse Hessian and gradient of each landmark.
    coupling : (N, 6, 3) float64
        Of camera and landmark, for `landmark_steps`.
    """
    H, g = np.zeros((6 * free, 6 * free)), np.zeros(6 * free)
    inverse, gradient = np.zeros((len(landmarks), 3, 3)), np.zeros((len(landmarks), 3))
    coupling = np.zeros((len(cameras), 6, 3))
    residual, J, J_point = np.empty(3), np.empty((3, 6)), np.empty((3, 3))
    own, moved = np.empty((3, 3)), np.empty((6, 3))
    first = 0
    for landmark in range(len(landmarks)):
        own[:] = 0.0
        last = first
        while last < len(cameras) and seen[last] == landmark:
            n, camera = last, cameras[last]
            last += 1
            pose = T[camera]
            if not _observe(pose, landmarks, landmark, pixels, depths, n, K, residual, J):
                continue
            error = 0.0
            for k in range(3):
                error += inverse_variance[n, k] * residual[k] ** 2
                for j in range(3):
                    J_point[k, j] = (
                        J[k, 3] * pose[0, j] + J[k, 4] * pose[1, j] + J[k, 5] * pose[2, j]
                    )
            kernel = 1.0 / (1.0 + error / bound) ** 2
            at = 6 * slots[camera]
            for k in range(3):
                weight = kernel * inverse_variance[n, k]
                for i in range(3):
                    gradient[landmark, i] += weight * J_point[k, i] * residual[k]
                    for j in range(3):
                        own[i, j] += weight * J_point[k, i] * J_point[k, j]
                if at < 0:
                    continue
                for i in range(6):
                    g[at + i] += weight * J[k, i] * residual[k]
                    for j in range(6):
                        H[at + i, at + j] += weight * J[k, i] * J[k, j]
                    for j in range(3):
                        coupling[n, i, j] += weight * J[k, i] * J_point[k, j]
        _invert(own, inverse[landmark])
        for n in range(first, last):
            at = 6 * slots[cameras[n]]
            if at < 0:
                continue
            _product(coupling[n], inverse[landmark], moved)
            for i in range(6):
                for k in range(3):
                    g[at + i] -= moved[i, k] * gradient[landmark, k]
            for m in range(first, last):
                to = 6 * slots[cameras[m]]
                if to < 0:
                    continue
                for i in range(6):
                    for j in range(6):
                        for k in range(3):
                            H[at + i, to + j] -= moved[i, k] * coupling[m, j, k]
        first = last
    return H, g, inverse, gradient, coupling


@compiled
def landmark_steps(
    steps: FloatArray,
    slots: IntArray,
    cameras: IntArray,
    seen: IntArray,
    inverse: FloatArray,
    gradient: FloatArray,
    coupling: FloatArray,
) -> FloatArray:
    """Return the steps of the landmarks (L, 3) that go with the cameras' steps (free, 6)."""
    total = gradient.copy()
    for n in range(len(cameras)):
        slot = slots[cameras[n]]
        if slot < 0:
            continue
        for k in range(3):
            for i in range(6):
                total[seen[n], k] += coupling[n, i, k] * steps[slot, i]
    for landmark in range(len(total)):
        x, y, z = total[landmark]
        for k in range(3):
            row = inverse[landmark, k]
            total[landmark, k] = -(row[0] * x + row[1] * y + row[2] * z)
    return total


@compiled
def _product(a: FloatArray, b: FloatArray, result: FloatArray) -> None:
    """Multiply (N, 3) by (3, 3)."""
    for i in range(len(a)):
        for j in range(3):
            result[i, j] = a[i, 0] * b[0, j] + a[i, 1] * b[1, j] + a[i, 2] * b[2, j]


@compiled
def _invert(A: FloatArray, result: FloatArray) -> None:
    """Invert a symmetric (3, 3) matrix that is positive semidefinite, and held a little.

    By its factors L D L^T, as landmarks seen from one side make it all but singular.
    """
    a = A[0, 0] + HOLD
    p, q = A[0, 1] / a, A[0, 2] / a
    b = A[1, 1] + HOLD - p * A[0, 1]
    r = (A[1, 2] - p * A[0, 2]) / b
    c = max(A[2, 2] + HOLD - q * A[0, 2] - r * r * b, HOLD)
    s = p * r - q  # The inverse of L has -p, s and -r below its diagonal.
    result[0, 0] = 1.0 / a + p * p / b + s * s / c
    result[1, 1] = 1.0 / b + r * r / c
    result[2, 2] = 1.0 / c
    result[0, 1] = result[1, 0] = -p / b - s * r / c
    result[0, 2] = result[2, 0] = s / c
    result[1, 2] = result[2, 1] = -r / c
