"""Leaves of doors: wood or glass, standing open, or opened while the camera comes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roomgraph.datasets.synthetic.plans.layout import Doorway, FloorPlan
from roomgraph.datasets.synthetic.rendering.mesh import FloatArray, Image, Material, Surfaces
from roomgraph.datasets.synthetic.rendering.shapes import tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.structure.moving import Stiff, smooth, turned
from roomgraph.datasets.synthetic.textures import homes, patterns, signs
from roomgraph.datasets.synthetic.textures.patterns import Colour

THICK_M = 0.04
OPENING_S, STAYS_OPEN_S = 1.2, 2.5
FACES: tuple[Colour, ...] = (
    (238, 236, 230), (150, 104, 64), (196, 160, 116), (120, 130, 140), (96, 66, 48),
    (214, 206, 190),
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class Swing:
    """Where a leaf turns.

    Attributes
    ----------
    hinge : (float, float)
        Its axis on the floor.
    closed : float
        Direction of the closed leaf from the hinge, radians.
    sense : {-1, 1}
        Whether it opens counter-clockwise (1) or clockwise.
    """

    hinge: tuple[float, float]
    closed: float
    sense: int

    def tip(self, angle: float, length: float) -> tuple[float, float]:
        """Return where the leaf's end is when it is opened by an angle."""
        direction = self.closed + self.sense * angle
        return (
            self.hinge[0] + length * float(np.cos(direction)),
            self.hinge[1] + length * float(np.sin(direction)),
        )


def swing(door: Doorway, plan: FloorPlan) -> Swing:
    """Return how a doorway's leaf turns: into its second room."""
    along = np.array((1.0, 0.0) if door.along == "x" else (0.0, 1.0))
    middle = np.array(door.xy)
    hinge = middle + along * door.hinge * door.width_m / 2
    to_latch = -door.hinge * along
    inwards = np.array(plan.room(door.rooms[1]).floor.centre) - middle
    cross = float(to_latch[0] * inwards[1] - to_latch[1] * inwards[0])
    closed = float(np.arctan2(to_latch[1], to_latch[0]))
    return Swing((float(hinge[0]), float(hinge[1])), closed, 1 if cross > 0 else -1)


def open_angle(door: Doorway, rng: np.random.Generator) -> float:
    """Draw how far a leaf is open, radians, after the doorway's state; a closed one when opened."""
    low, high = (56, 66) if door.state == "half" else (82, 100)
    return float(np.deg2rad(rng.uniform(low, high)))


def build_leaf(surfaces: Surfaces, door: Doorway, turn: Swing, angle: float, face: Image) -> None:
    """Build a doorway's leaf, opened by an angle."""
    direction = turn.closed + turn.sense * angle
    facing = float(np.arctan2(-np.cos(direction), np.sin(direction)))
    stand = Stand(surfaces, (*turn.hinge, door.base_m), facing)
    with surfaces.thing("door"):
        if door.is_glass:
            _glass(stand, door)
        else:
            _wooden(stand, door, face)
        metal = Material(patterns.plain(8, 8, (176, 178, 182)), 4.0, 4.0)
        grip = door.width_m - 0.07
        for y in (-0.05, 0.05):
            tube(stand, (grip, y, 1.04), (grip - 0.12, y, 1.04), 0.011, metal)


def _wooden(stand: Stand, door: Doorway, face: Image) -> None:
    rng = stand.rng
    is_numbered = rng.random() < 0.4
    drawn = signs.door(rng, face, int(rng.integers(100, 400))) if is_numbered else None
    leaf = Material(homes.panelled_door(rng, face) if drawn is None else drawn)
    edge = Material(face[:64, :64], 0.5, 0.5)
    x, y, z = (0.01, door.width_m - 0.01), (-THICK_M / 2, THICK_M / 2), (0.01, door.height_m - 0.01)
    stand.box(x, y, z, edge, front=leaf)
    stand.picture(x, z, y[1] + 0.001, leaf)
    behind = stand.at((x[0] + x[1]) / 2, y[0] - 0.001, 0, np.pi)
    half = (x[1] - x[0]) / 2
    behind.picture((-half, half), z, 0.0, leaf)


def _glass(stand: Stand, door: Doorway) -> None:
    """Build a leaf whose pane cannot be seen: its rim, and the stripes that warn of it."""
    metal = Material(patterns.plain(8, 8, (96, 100, 106)), 4.0, 4.0)
    white = Material(patterns.plain(8, 8, (226, 232, 236)), 4.0, 4.0)
    width, height, y = door.width_m, door.height_m, (-THICK_M / 2, THICK_M / 2)
    for x in (0.01, width - 0.08):
        stand.box((x, x + 0.07), y, (0.01, height - 0.01), metal)
    for z in ((0.01, 0.2), (height - 0.1, height - 0.01)):
        stand.box((0.08, width - 0.08), y, z, metal)
    for stripe in (0.95, 1.05, 1.5):
        stand.box((0.08, width - 0.08), (-0.003, 0.003), (stripe, stripe + 0.03), white)


def opened_on_the_way(
    surfaces: Surfaces, door: Doorway, turn: Swing, angle: float, face: Image, passes: FloatArray
) -> Stiff:
    """Return a closed leaf that opens before the camera passes, and closes some time later.

    `passes` (N,) are the times when the camera goes through, seconds.
    """
    first = len(surfaces.quads)
    build_leaf(surfaces, door, turn, 0.0, face)
    quads = surfaces.quads[first:]
    del surfaces.quads[first:]
    surfaces.things.pop()

    def motion(stamp_s: float) -> FloatArray:
        opened = 0.0
        for moment in passes:
            begin = float(moment) - 2.0 - OPENING_S
            end = float(moment) + STAYS_OPEN_S
            closing = smooth(stamp_s, end, end + OPENING_S)
            opened = max(opened, smooth(stamp_s, begin, begin + OPENING_S) - closing)
        return turned(turn.hinge, turn.sense * angle * opened)

    return Stiff(quads, motion)


def leaf_face(rng: np.random.Generator) -> Image:
    """Return what the leaves of a building are made of, for `build_leaf`."""
    colour = patterns.pick(rng, FACES)
    if rng.random() < 0.5:
        return patterns.wood(rng, 520, 240, colour)
    return patterns.plaster(rng, 520, 240, colour)


def leaf_outline(door: Doorway, turn: Swing, angle: float) -> FloatArray:
    """Return the corners (4, 2) on the floor of a leaf opened by an angle."""
    a, b = np.array(turn.hinge), np.array(turn.tip(angle, door.width_m))
    aside = np.array([a[1] - b[1], b[0] - a[0]]) / door.width_m * (THICK_M / 2 + 0.03)
    return np.array([a + aside, b + aside, b - aside, a - aside])
