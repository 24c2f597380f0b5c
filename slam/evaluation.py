"""Trajectory errors against ground truth, as evo computes them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets import se3
from roomgraph.datasets.trajectory import Trajectory
from roomgraph.slam.errors import SlamError
from roomgraph.slam.geometry.motion import procrustes

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class TrajectoryError:
    """How far an estimate is from the truth.

    Attributes
    ----------
    ate_rmse_m : float
        Absolute trajectory error: position, after the best rigid alignment.
    ate_median_m, ate_max_m : float
        Of the same errors.
    rpe_trans_rmse_m, rpe_rot_rmse_deg : float
        Relative pose error from each compared pose to the next.
    T_truth_estimate : (4, 4) float64
        The alignment.
    errors_m : (N,) float64
        Position error of each compared pose.
    stamps_s : (N,) float64
        Of the compared poses.
    """

    ate_rmse_m: float
    ate_median_m: float
    ate_max_m: float
    rpe_trans_rmse_m: float
    rpe_rot_rmse_deg: float
    T_truth_estimate: FloatArray
    errors_m: FloatArray
    stamps_s: FloatArray


def compare(
    estimate: Trajectory, truth: Trajectory, max_difference_s: float = 0.01
) -> TrajectoryError:
    """Compare an estimate with the truth (Sturm et al., 2012; Umeyama alignment without scale).

    Poses are paired by nearest stamp within `max_difference_s`.

    Raises
    ------
    SlamError
        Fewer than three poses pair up.
    """
    nearest = truth.nearest(estimate.stamps_s, max_difference_s)
    paired = nearest >= 0
    if paired.sum() < 3:
        raise SlamError(
            "trajectory cannot be compared with the ground truth",
            expected=f"at least 3 poses with true ones within {max_difference_s} s",
            got=f"{int(paired.sum())} of {len(estimate)}",
        )
    P, Q = estimate.T_world_camera[paired], truth.T_world_camera[nearest[paired]]
    T = procrustes(P[:, :3, 3], Q[:, :3, 3])
    errors = np.linalg.norm(se3.transform(T, P[:, :3, 3]) - Q[:, :3, 3], axis=1)
    steps = se3.inverse(Q[:-1]) @ Q[1:]
    E = se3.inverse(steps) @ (se3.inverse(P[:-1]) @ P[1:])
    angles = np.degrees([se3.rotation_angle(e) for e in E])
    return TrajectoryError(
        ate_rmse_m=_rms(errors), ate_median_m=float(np.median(errors)),
        ate_max_m=float(errors.max()), rpe_trans_rmse_m=_rms(np.linalg.norm(E[:, :3, 3], axis=1)),
        rpe_rot_rmse_deg=_rms(angles), T_truth_estimate=T, errors_m=errors,
        stamps_s=estimate.stamps_s[paired],
    )  # fmt: skip


def _rms(values: FloatArray) -> float:
    return float(np.sqrt(np.mean(values**2)))
