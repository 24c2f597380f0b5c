"""A person's body: surfaces that hang on the parts of a skeleton."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roomgraph.datasets.synthetic.people.gait import (
    ARMS,
    HEAD,
    LEGS,
    NECK,
    PARTS,
    PELVIS,
    TORSO,
    FloatArray,
)  # fmt: skip
from roomgraph.datasets.synthetic.people.lofts import Builder, Section, Weights, mass_of
from roomgraph.datasets.synthetic.people.outfit import Outfit, draw_outfit
from roomgraph.datasets.synthetic.rendering.mesh import Material, Quad


@dataclass(frozen=True, slots=True, eq=False)
class Figure:
    """A body that stands upright at the origin, facing along x, its left side along y.

    Attributes
    ----------
    quads : list of Quad
        Its surfaces.
    weights : (N, 4, P) float64
        How much of each corner moves with which of the `PARTS`; they add up to 1.
    joints : (P, 3) float64
        Where the parts' frames are; these have the axes of the body.
    height_m : float
        From the floor to the crown.
    outfit : Outfit
        What the person looks like.
    """

    quads: list[Quad]
    weights: FloatArray
    joints: FloatArray
    height_m: float
    outfit: Outfit

    @property
    def seat_m(self) -> float:
        """How high the hips are above what the person sits on."""
        return float(0.052 * self.height_m)


def draw_figure(rng: np.random.Generator) -> Figure:
    """Draw a person."""
    outfit = draw_outfit(rng)
    builder = Builder(_joints(outfit), outfit.height_m / 1.75)
    _trunk(builder, outfit)
    for side in (0, 1):
        _arm(builder, outfit, side)
        _leg(builder, outfit, side)
    _head(builder, outfit)
    if outfit.backpack is not None:
        _backpack(builder, outfit.backpack, outfit.girth)
    weights = np.array(builder.weights)
    return Figure(builder.quads, weights, builder.joints, outfit.height_m, outfit)


def _joints(outfit: Outfit) -> FloatArray:
    """Return where the joints are, by the usual proportions of the body."""
    joints = np.zeros((len(PARTS), 3))
    joints[[PELVIS, TORSO, NECK, HEAD], 2] = 0.53, 0.60, 0.835, 0.872
    for sign, arm, leg in zip((1, -1), ARMS, LEGS, strict=True):
        joints[list(arm), 1] = sign * (0.099 if outfit.woman else 0.107) * outfit.breadth
        joints[list(arm), 2] = 0.805, 0.628, 0.482
        joints[list(leg), 1] = sign * 0.050
        joints[list(leg), 2] = 0.515, 0.280, 0.045
    return joints * outfit.height_m


def _trunk(builder: Builder, outfit: Outfit) -> None:
    """Add chest, belly and hips, and a skirt or a coat."""
    g, b, woman = outfit.girth, outfit.breadth, outfit.woman
    belly, chest = (0.122, 0.165) if woman else (0.142, 0.172 * b)
    bust = 0.022 if woman else 0.0
    hip = 0.170 if woman else 0.158
    mixed: Weights = ((PELVIS, 0.5), (TORSO, 0.5))
    sections: list[Section] = [
        (0.425, -0.012, 0.054, 0.064), (0.398, -0.014, 0.076, 0.128 * b),
        (0.352, -0.010, 0.098, chest + 0.008),
        (0.235, 0.004 + bust / 2, 0.112 * g + bust / 2, chest * g),
        (0.105, 0.004, 0.102 * g + bust / 4, (belly + 0.018) * g),
        (0.0, 0.004, 0.100 * g, belly * g),
        (-0.170, -0.006, 0.126 * g, (hip + 0.012) * g),
    ]  # fmt: skip
    weights = [None, None, None, None, None, mixed, ((PELVIS, 1.0),)]
    builder.loft(
        TORSO, sections, outfit.top, sides=8, weights=weights, square=0.80, cap=(True, False)
    )
    if outfit.drape is not None:
        long = outfit.drape_m
        flare = 1.0 if outfit.coat else 1.12
        hem: list[Section] = [
            (0.10, 0.002, 0.104 * g, (belly + 0.008) * g),
            (-0.055, -0.006, 0.126 * g, (hip + 0.012) * g),
            (-0.055 - 0.5 * long, 0.004, 0.140 * g * flare, (hip + 0.014) * g * flare),
            (-0.055 - long, 0.010, 0.150 * g * flare, (hip + 0.010) * g * flare),
        ]  # fmt: skip
        builder.loft(
            PELVIS, hem, outfit.drape, sides=10, weights=[mixed], spread=[0.0, 0.1, 0.65, 0.95],
            square=0.9,
        )  # fmt: skip
        return
    builder.loft(
        PELVIS,
        [(-0.03, -0.006, 0.107 * g, (hip - 0.013) * g), (-0.07, -0.006, 0.112 * g, hip * g),
         (-0.12, 0.0, 0.070 * g, 0.100 * g)],
        outfit.legs, sides=8, square=0.85,
    )  # fmt: skip


def _arm(builder: Builder, outfit: Outfit, side: int) -> None:
    """Add an arm with its hand."""
    upper, lower, hand = ARMS[side]
    g, s = (0.95 if outfit.woman else 1.1) * outfit.girth, builder.scale
    first = float(builder.joints[upper, 2] - builder.joints[lower, 2]) / s
    second = float(builder.joints[lower, 2] - builder.joints[hand, 2]) / s
    sections = [
        (0.032, -0.004, 0.026, 0.020), (0.004, 0.0, 0.058 * g, 0.047 * g),
        (-0.45 * first, 0.0, 0.053 * g, 0.049 * g), (-first, 0.0, 0.045 * g, 0.043 * g),
        (-first - second - 0.01, 0.0, 0.032 * g, 0.029 * g),
    ]  # fmt: skip
    elbow: Weights = ((upper, 0.5), (lower, 0.5))
    shoulder: Weights = ((TORSO, 0.6), (upper, 0.4))
    weights = [shoulder, None, None, elbow, ((lower, 1.0),)]
    builder.loft(upper, sections, outfit.sleeve, sides=6, weights=weights)
    palm = [
        (0.015, 0.0, 0.026, 0.021),
        (-0.075, 0.006, 0.043, 0.019),
        (-0.165, 0.012, 0.016, 0.010),
    ]
    builder.loft(hand, palm, outfit.skin, sides=4)


def _leg(builder: Builder, outfit: Outfit, side: int) -> None:
    """Add a leg with its shoe."""
    thigh, shin, shoe = LEGS[side]
    g, s = outfit.girth, builder.scale
    first = float(builder.joints[thigh, 2] - builder.joints[shin, 2]) / s
    second = float(builder.joints[shin, 2] - builder.joints[shoe, 2]) / s
    bare = 0.85 if outfit.bare_legs else 1.0
    hem = (0.040 if outfit.bare_legs else 0.062) * outfit.leg_width
    sections = [
        (0.02, 0.0, 0.088 * g, 0.068 * g * bare),
        (-0.45 * first, 0.006, 0.080 * g, 0.074 * g * bare),
        (-first, 0.006, 0.062 * g * bare, 0.058 * g * bare),
        (-first - 0.35 * second, -0.012, 0.061 * g * bare, 0.056 * g * bare),
        (-first - second - 0.01, -0.012, hem, 0.86 * hem),
    ]  # fmt: skip
    knee: Weights = ((thigh, 0.5), (shin, 0.5))
    hip: Weights = ((PELVIS, 0.5), (thigh, 0.5))
    weights = [hip, None, knee, ((shin, 1.0),), ((shin, 1.0),)]
    builder.loft(thigh, sections, outfit.legs, sides=6, weights=weights)
    floor = -float(builder.joints[shoe, 2]) / s
    k = 0.9 if outfit.woman else 1.0
    sole = [
        (0.022, -0.010, 0.050, 0.042), (floor + 0.040, 0.045, 0.125 * k, 0.047 * k),
        (floor, 0.046, 0.134 * k, 0.049 * k),
    ]  # fmt: skip
    builder.loft(shoe, sole, outfit.shoe, sides=6, square=0.8, cap=(False, True))


def _head(builder: Builder, outfit: Outfit) -> None:
    """Add neck, head, nose and hair."""
    k = 0.94 if outfit.woman else 1.0
    thin = 0.050 if outfit.woman else 0.061
    # It ends at the chin and at the collar: light is taken at the corners, none inside the body.
    neck = [
        (0.064, 0.002, thin, thin), (0.030, -0.002, thin, thin),
        (-0.002, -0.009, thin * 1.15, thin * 1.2),
    ]  # fmt: skip
    builder.loft(NECK, neck, outfit.skin, sides=5, weights=[((HEAD, 1.0),)])
    up, k = 0.128 * 1.75, 1.08 * k
    head: list[Section] = [
        (up, -0.008, 0.052 * k, 0.040 * k), (0.88 * up, -0.006, 0.086 * k, 0.064 * k),
        (0.58 * up, 0.0, 0.100 * k, 0.077 * k), (0.26 * up, 0.010, 0.088 * k, 0.067 * k),
        (0.0, 0.028, 0.058 * k, 0.040 * k),
    ]  # fmt: skip
    builder.loft(HEAD, head, outfit.head, sides=8, square=0.92, cap=(True, True))
    place, mass = builder.joints[HEAD], np.tile(mass_of(((HEAD, 1.0),)), (4, 1))
    bridge, tip = (0.096 * k, 0.0, 0.50 * up), (0.122 * k, 0.0, 0.335 * up)
    base = (0.094 * k, 0.0, 0.31 * up)
    for sign in (1, -1):
        wing = (0.090 * k, 0.019 * sign, 0.325 * up)
        corners = [bridge, wing, base, tip] if sign == 1 else [bridge, tip, base, wing]
        builder.add(np.array(corners) * builder.scale + place, mass, outfit.nose)
    if outfit.hair is None:
        return
    # Its rim lies inside the forehead, where the head's own image shows the hairline.
    crown: list[Section] = [
        (1.05 * up, -0.012, 0.056 * k, 0.046 * k), (0.93 * up, -0.010, 0.096 * k, 0.074 * k),
        (0.74 * up, -0.020, 0.096 * k, 0.084 * k),
    ]  # fmt: skip
    builder.loft(HEAD, crown, outfit.hair, sides=8, square=0.92, cap=(True, False))
    low = outfit.hair_to_m
    back: list[Section] = [
        (0.78 * up, -0.018, 0.100 * k, 0.085 * k), (0.35 * up, -0.020, 0.098 * k, 0.086 * k),
        (low, -0.026, (0.090 if low < 0 else 0.066) * k, 0.080 * k),
    ]  # fmt: skip
    builder.loft(HEAD, back, outfit.hair, sides=4, arc=(0.54 * np.pi, 1.46 * np.pi))


def _backpack(builder: Builder, material: Material, girth: float) -> None:
    """Add a backpack with two straps."""
    mid = -0.105 * girth - 0.065
    sack = [(0.36, mid + 0.02, 0.040, 0.11), (0.32, mid, 0.075, 0.145), (-0.02, mid, 0.085, 0.15)]
    builder.loft(TORSO, sack, material, sides=6, square=0.7, cap=(False, True))
