"""Shapes that boxes and prisms do not make: turned, slanting, soft, hollow; built at a stand."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from roomgraph.datasets.synthetic.rendering.mesh import FloatArray, Material, Quad
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.vectors import unit

Point = tuple[float, float, float]


def lathe(
    stand: Stand,
    centre: tuple[float, float],
    profile: Sequence[tuple[float, float]],
    material: Material,
    *,
    sides: int = 12,
    stretch: float = 1.0,
) -> None:
    """Turn a profile of (radius, height) round an upright axis, bottom to top.

    `stretch` makes it oval: how many times as deep (y) as wide. The ends are closed when their
    radius is not 0. The material's image goes once round.
    """
    angles = np.arange(sides + 1) * 2 * np.pi / sides + np.pi / sides
    ring = np.column_stack([np.cos(angles), stretch * np.sin(angles), np.zeros(sides + 1)])
    levels = [ring * radius + (*centre, z) for radius, z in profile]
    heights = np.linspace(1, 0, len(levels))
    for k in range(len(levels) - 1):
        low, high = levels[k], levels[k + 1]
        for i in range(sides):
            corners = stand.world(np.array([high[i + 1], high[i], low[i], low[i + 1]]))
            left, right = (sides - 1 - i) / sides, (sides - i) / sides
            window = (left, float(heights[k + 1]), right, float(heights[k]))
            stand.surfaces.quads.append(Quad(corners, material, window))
    if profile[-1][0] > 0:
        _cap(stand, levels[-1], material)
    if profile[0][0] > 0 and profile[0][1] + stand.origin[2] > 0.05:
        _cap(stand, levels[0][::-1], material)
    reach = max(radius for radius, _ in profile)
    x, y = centre
    stand.footprint(
        (x - reach, x + reach), (y - stretch * reach, y + stretch * reach), profile[0][1]
    )


def _cap(stand: Stand, ring: FloatArray, material: Material) -> None:
    """Close a ring of points, the last one the first, with quads.

    It goes round counter-clockwise in the stand's frame, which is left-handed: clockwise as seen
    from outside, as every quad does.
    """
    count = len(ring) - 1
    for i in range(1, count - 1, 2):
        stand.surfaces.picture(stand.world(ring[[i, i + 1, min(i + 2, count), 0]]), material)


def tube(
    stand: Stand,
    begin: Point,
    end: Point,
    radius: float | tuple[float, float],
    material: Material,
    *,
    sides: int = 6,
) -> None:
    """Join two points with a round bar; `radius` may differ at its ends. No footprint."""
    a, b = np.array(begin, dtype=np.float64), np.array(end, dtype=np.float64)
    first, last = radius if isinstance(radius, tuple) else (radius, radius)
    axis = unit(b - a)
    aside = unit(np.cross(axis, (0, 0, 1) if abs(axis[2]) < 0.9 else (1, 0, 0)))
    other = np.cross(axis, aside)
    angles = np.arange(sides + 1) * 2 * np.pi / sides
    ring = np.cos(angles)[:, None] * aside + np.sin(angles)[:, None] * other
    low, high = a + first * ring, b + last * ring
    for i in range(sides):
        corners = stand.world(np.array([high[i + 1], high[i], low[i], low[i + 1]]))
        window = ((sides - 1 - i) / sides, 0.0, (sides - i) / sides, 1.0)
        stand.surfaces.quads.append(Quad(corners, material, window))
    _cap(stand, high, material)
    _cap(stand, low[::-1], material)


def block(stand: Stand, top: Sequence[Point], bottom: Sequence[Point], material: Material) -> None:
    """Add a body with six sides from its upper and its lower four corners.

    Both go round counter-clockwise as seen from above: front left, front right, back right, back
    left, where the front is towards the viewer (y large). No footprint: add one if it stands on
    the floor.
    """
    t, b = np.array(top, dtype=np.float64), np.array(bottom, dtype=np.float64)
    sides = [
        t[[3, 2, 1, 0]], b[[0, 1, 2, 3]],
        *(np.array([t[i], t[(i + 1) % 4], b[(i + 1) % 4], b[i]]) for i in range(4)),
    ]  # fmt: skip
    for corners in sides:
        _patch(stand, corners, material)


def _patch(stand: Stand, corners: FloatArray, material: Material) -> None:
    """Add one quad of any form, with as much of the material's image as it has room for."""
    right = np.linalg.norm(corners[1] - corners[0]) + np.linalg.norm(corners[2] - corners[3])
    down = np.linalg.norm(corners[3] - corners[0]) + np.linalg.norm(corners[2] - corners[1])
    window = (
        0.0, 0.0,
        min(1.0, float(right) / 2 / material.width_m),
        min(1.0, float(down) / 2 / material.height_m),
    )  # fmt: skip
    stand.surfaces.quads.append(Quad(stand.world(corners), material, window))


def cushion(
    stand: Stand,
    x: tuple[float, float],
    y: tuple[float, float],
    z: tuple[float, float],
    material: Material,
    *,
    bevel: float = 0.05,
) -> None:
    """Add a soft box: its upper edges are cut by `bevel` metres. Footprint as a box's."""
    bevel = min(bevel, 0.45 * (x[1] - x[0]), 0.45 * (y[1] - y[0]), 0.9 * (z[1] - z[0]))
    edge = z[1] - bevel
    outer = [(x[0], y[1]), (x[1], y[1]), (x[1], y[0]), (x[0], y[0])]
    inner = [
        (x[0] + bevel, y[1] - bevel), (x[1] - bevel, y[1] - bevel),
        (x[1] - bevel, y[0] + bevel), (x[0] + bevel, y[0] + bevel),
    ]  # fmt: skip
    rings = [[(*p, h) for p in ring] for ring, h in ((inner, z[1]), (outer, edge), (outer, z[0]))]
    top, middle, foot = (np.array(ring) for ring in rings)
    stand.surfaces.cover(stand.world(top[[3, 2, 1, 0]]), material)
    for high, low in ((top, middle), (middle, foot)):
        for i in range(4):
            j = (i + 1) % 4
            _patch(stand, np.array([high[i], high[j], low[j], low[i]]), material)
    if z[0] > 0.3:
        stand.surfaces.cover(stand.world(foot[[0, 1, 2, 3]]), material)
    stand.footprint(x, y, z[0])


def ring(
    centre: tuple[float, float, float],
    reach: tuple[float, float],
    *,
    sides: int = 12,
    corner: float = 1.0,
) -> FloatArray:
    """Return a level ring of points round a centre, for `loft`.

    It reaches `reach` in x and y; `corner` 1 is an oval, 0.25 a rectangle with round corners.
    """
    turns = np.arange(sides) * 2 * np.pi / sides + np.pi / 2
    c, s = np.cos(turns), np.sin(turns)
    x, y = (np.sign(v) * np.abs(v) ** corner for v in (c, s))
    return np.asarray(np.column_stack([reach[0] * x, -reach[1] * y, np.zeros(sides)]) + centre)


def loft(
    stand: Stand, rings: Sequence[FloatArray], material: Material, *, closed: bool = True
) -> None:
    """Join rings with equal numbers of points, from the foot upwards, and close the last one.

    Rings that lead inwards and down again make it hollow.
    """
    count = len(rings[0])
    for low, high in pairwise(rings):
        for i in range(count):
            corners = np.array([high[i], high[(i + 1) % count], low[(i + 1) % count], low[i]])
            window = (i / count, 0.0, (i + 1) / count, 1.0)
            stand.surfaces.quads.append(Quad(stand.world(corners), material, window))
    top = rings[-1]
    for i in range(1, count - 1, 2) if closed else ():
        corners = top[[min(i + 2, count - 1), i + 1, i, 0]]
        stand.surfaces.picture(stand.world(corners), material)
    (x0, y0, z0), (x1, y1, _) = np.concatenate(rings).min(axis=0), np.concatenate(rings).max(axis=0)
    stand.footprint((float(x0), float(x1)), (float(y0), float(y1)), float(z0))
