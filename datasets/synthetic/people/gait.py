"""How people move: poses as joint angles, and where the parts of the body are in a pose."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

FloatArray = NDArray[np.float64]

PARTS = (
    "pelvis", "torso", "neck", "head", "left_upper_arm", "left_forearm", "left_hand",
    "right_upper_arm", "right_forearm", "right_hand", "left_thigh", "left_shin", "left_shoe",
    "right_thigh", "right_shin", "right_shoe",
)  # fmt: skip
PARENTS = (-1, 0, 1, 2, 1, 4, 5, 1, 7, 8, 0, 10, 11, 0, 13, 14)
PELVIS, TORSO, NECK, HEAD = range(4)
# Upper and lower arm and hand, thigh and shin and shoe; the left one and the right one.
ARMS = ((4, 5, 6), (7, 8, 9))
LEGS = ((10, 11, 12), (13, 14, 15))
ROLL, PITCH, YAW = range(3)
SAMPLES = 128

# Bend of a leg's joints over a stride that begins with its heel on the floor: share of the
# stride, degrees (the usual curves of gait laboratories).
HIP = ((0, 28), (0.15, 21), (0.3, 6), (0.5, -12), (0.6, -6), (0.75, 20), (0.87, 31), (1, 28))
KNEE = ((0, 4), (0.14, 15), (0.4, 4), (0.55, 20), (0.72, 58), (0.87, 25), (0.96, 3), (1, 4))
ANKLE = ((0, 0), (0.07, -6), (0.25, 5), (0.45, 10), (0.62, -16), (0.8, 0), (1, 0))


@dataclass(frozen=True, slots=True, eq=False)
class Pose:
    """Angles of all joints.

    Attributes
    ----------
    angles : (P, 3) float64
        For each of `PARTS`, how it is turned against its parent: about the axis forwards (roll),
        to the left (pitch; bends a hanging limb backwards) and upwards (yaw), radians.
    """

    angles: FloatArray


def _curve(points: tuple[tuple[float, float], ...]) -> FloatArray:
    """Return a periodic curve through points, `SAMPLES` + 1 values, radians."""
    phase, degrees = np.array(points, dtype=np.float64).T
    spline = CubicSpline(phase, np.deg2rad(degrees), bc_type="periodic")
    return np.asarray(spline(np.linspace(0, 1, SAMPLES + 1)), dtype=np.float64)


def _walk_table() -> FloatArray:
    """Return the angles (SAMPLES + 1, P, 3) over one stride."""
    table = np.zeros((SAMPLES + 1, len(PARTS), 3))
    turn = 2 * np.pi * np.linspace(0, 1, SAMPLES + 1)
    hip, knee, ankle = _curve(HIP), _curve(KNEE), _curve(ANKLE)
    for side, (thigh, shin, shoe) in enumerate(LEGS):
        later = side * SAMPLES // 2
        shift = (np.arange(SAMPLES + 1) + later) % SAMPLES
        table[:, thigh, PITCH] = -hip[shift]
        table[:, shin, PITCH] = knee[shift]
        table[:, shoe, PITCH] = -ankle[shift]
    for side, (upper, lower, _) in enumerate(ARMS):
        swing = np.cos(turn + np.pi * side - 0.25)
        table[:, upper, PITCH] = np.deg2rad(19 * swing)
        table[:, lower, PITCH] = np.deg2rad(-14 + 10 * swing)
    # The side of the leg in front is turned forwards, the shoulders the other way.
    table[:, PELVIS, YAW] = np.deg2rad(-4 * np.cos(turn))
    table[:, PELVIS, ROLL] = np.deg2rad(2.0 * np.sin(turn))
    table[:, TORSO, YAW] = np.deg2rad(9 * np.cos(turn))
    table[:, TORSO, ROLL] = np.deg2rad(-2.8 * np.sin(turn))
    table[:, HEAD, YAW] = np.deg2rad(-4 * np.cos(turn))
    for thigh, shoe in ((leg[0], leg[2]) for leg in LEGS):
        table[:, thigh, ROLL] = -table[:, PELVIS, ROLL]
        table[:, shoe, YAW] = -table[:, PELVIS, YAW]
    return table


# Parts that are equally many joints away from the pelvis, and their parents.
_PARENTS = np.array(PARENTS)
_LEVELS = [
    (np.array(parts), _PARENTS[list(parts)])
    for parts in ((1, 10, 13), (2, 4, 7, 11, 14), (3, 5, 8, 12, 15), (6, 9))
]
_WALK = _walk_table()
_SIDES = (1.0, -1.0)


def _hanging() -> FloatArray:
    """Return what all poses begin with: arms a little off the body, feet a little outwards."""
    angles = np.zeros((len(PARTS), 3))
    for sign, arm, leg in zip(_SIDES, ARMS, LEGS, strict=True):
        angles[arm[0], ROLL] = sign * np.deg2rad(7)
        angles[arm[1], ROLL] = sign * np.deg2rad(-4)
        angles[leg[2], YAW] = sign * np.deg2rad(7)
    return angles


_HANGING = _hanging()


def walking(phase: float, speed: float = 1.2) -> Pose:
    """Return the pose at a share of a stride (0 to 1; the left heel touches the floor at 0).

    The steps are longer at a higher `speed`, metres a second.
    """
    place = (phase % 1.0) * SAMPLES
    first = min(int(place), SAMPLES - 1)
    share = place - first
    angles = (1 - share) * _WALK[first] + share * _WALK[first + 1]
    angles *= min(max(0.55 + 0.375 * speed, 0.5), 1.15)
    angles += _HANGING
    angles[TORSO, PITCH] += np.deg2rad(1.5 + 1.5 * speed)
    angles[HEAD, PITCH] -= np.deg2rad(1.5 + 1.0 * speed)
    return Pose(angles)


def standing(t: float = 0.0) -> Pose:
    """Return the pose of somebody who stands and sways a little, at a time in seconds."""
    angles = _HANGING.copy()
    lean = np.deg2rad(1.0) * np.sin(0.9 * t)
    for _, _, shoe in LEGS:
        angles[shoe, ROLL] = -lean
    angles[PELVIS, ROLL] = lean
    angles[TORSO, ROLL] = -1.3 * lean
    angles[TORSO, PITCH] = np.deg2rad(1.0 + 0.6 * np.sin(1.6 * t + 1))
    angles[HEAD] = np.deg2rad([0.0, 3 + 3 * np.sin(0.5 * t + 2), 14 * np.sin(0.37 * t)])
    for upper, lower, _ in ARMS:
        angles[upper, PITCH] = np.deg2rad(1.5 * np.sin(0.8 * t + upper))
        angles[lower, PITCH] = np.deg2rad(-13)
    return Pose(angles)


def sitting(t: float = 0.0, drop: float = 0.0) -> Pose:
    """Return the pose of somebody on a chair, the hands on the thighs.

    `drop` tells how far the knees lie below the hips: the thighs' slope, radians.
    """
    angles = standing(t).angles
    angles[PELVIS] = np.deg2rad([0, -9, 0])
    angles[TORSO] = np.deg2rad([0, 8 + 1.0 * np.sin(0.4 * t), 3 * np.sin(0.21 * t)])
    angles[HEAD, PITCH] += np.deg2rad(6)
    for sign, arm, (thigh, shin, shoe) in zip(_SIDES, ARMS, LEGS, strict=True):
        level = -np.pi / 2 + drop
        angles[thigh] = (0, level - angles[PELVIS, PITCH], sign * np.deg2rad(7))
        angles[shin] = (0, np.deg2rad(88) - drop, 0)
        angles[shoe] = (0, np.deg2rad(2), 0)
        angles[arm[0]] = np.deg2rad([sign * 6, -16, 0])
        angles[arm[1]] = np.deg2rad([0, -45, sign * -16])
        angles[arm[2]] = np.deg2rad([0, -12, sign * -55])
    return Pose(angles)


def blend(first: Pose, second: Pose, share: float) -> Pose:
    """Return a pose between two: the first at a share of 0, the second at 1."""
    return Pose((1 - share) * first.angles + share * second.angles)


def rotations(angles: FloatArray) -> FloatArray:
    """Return the rotations (P, 3, 3) of roll, then pitch, then yaw (P, 3)."""
    (cr, cp, cy), (sr, sp, sy) = np.cos(angles).T, np.sin(angles).T
    R = np.empty((len(angles), 3, 3))
    R[:, 0, 0], R[:, 0, 1], R[:, 0, 2] = cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr
    R[:, 1, 0], R[:, 1, 1], R[:, 1, 2] = sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr
    R[:, 2, 0], R[:, 2, 1], R[:, 2, 2] = -sp, cp * sr, cp * cr
    return R


def part_transforms(joints: FloatArray, pose: Pose, root: FloatArray) -> FloatArray:
    """Return where the parts' frames (P, 4, 4) are.

    Parameters
    ----------
    joints : (P, 3) float64
        Where the parts' frames are when the body stands upright at the origin, facing along x
        with its left side along y.
    pose : Pose
        The angles.
    root : (4, 4) float64
        Moves the body's frame, which lies on the floor, to the world.
    """
    local = np.zeros((len(PARTS), 4, 4))
    local[:, :3, :3] = rotations(pose.angles)
    local[:, 3, 3] = 1
    local[0, :3, 3] = joints[0]
    local[1:, :3, 3] = joints[1:] - joints[_PARENTS[1:]]
    T = np.empty_like(local)
    T[0] = root @ local[0]
    for parts, parents in _LEVELS:
        T[parts] = T[parents] @ local[parts]
    return T
