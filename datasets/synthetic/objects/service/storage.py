"""Racks and work benches with their load."""

from __future__ import annotations

from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.objects.service.stock import (
    STEEL,
    put_can,
    put_carton,
    put_crate,
    put_toolbox,
)
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import laboratory, patterns
from roomgraph.datasets.synthetic.textures.patterns import pick

__all__ = ["storage_rack", "work_bench"]


def storage_rack(stand: Stand, look: Look, *, width: float = 1.2) -> None:
    """Build a metal shelf loaded with boxes, crates, paint cans and tool boxes."""
    rng, half, tall = stand.rng, width / 2, float(stand.rng.uniform(1.75, 2.1))
    post = paint(pick(rng, (STEEL, (40, 80, 150), (70, 74, 80), (200, 90, 30))))
    board = paint(pick(rng, (STEEL, (206, 176, 130), (200, 90, 30))))
    levels = int(rng.integers(4, 6))
    pitch = (tall - 0.15) / (levels - 1)
    with stand.surfaces.thing("storage_rack"):
        for x in (-half, half - 0.04):
            for y in (0.0, 0.46):
                stand.box((x, x + 0.04), (y, y + 0.04), (0.0, tall), post)
        for level in range(levels):
            z = 0.1 + pitch * level
            stand.box((-half + 0.01, half - 0.01), (0.02, 0.49), (z - 0.03, z), board)
            x = -half + 0.06
            while x < half - 0.3 and level < levels - (rng.random() < 0.4):
                x += _load(stand, x, z, min(0.6, half - 0.05 - x), pitch - 0.08)


def _load(stand: Stand, x: float, z: float, room: float, tall: float) -> float:
    """Put one thing on a shelf at its left end `x`; return how much of the shelf it takes."""
    rng, kind = stand.rng, int(stand.rng.integers(6))
    if kind == 0:
        put_can(stand, x + 0.1, float(rng.uniform(0.2, 0.36)), z)
        return 0.22
    if kind == 1 and room > 0.46:
        put_toolbox(stand, x + 0.23, 0.27, z)
        return 0.5
    wide = min(room, float(rng.uniform(0.26, 0.46)))
    front, high = float(rng.uniform(0.38, 0.47)), float(rng.uniform(0.5, 1.0)) * min(tall, 0.4)
    if kind == 2:
        put_crate(stand, (x, x + wide), (0.06, front), (z, z + min(high, 0.24)))
    else:
        put_carton(stand, (x, x + wide), (0.06, front), (z, z + high))
    return wide + float(rng.uniform(0.02, 0.15))


def work_bench(stand: Stand, look: Look) -> None:
    """Build a work bench: thick top, drawers, vice, tools, a pegboard above."""
    rng, half = stand.rng, float(stand.rng.uniform(0.65, 0.95))
    beech = pick(rng, ((190, 146, 92), (150, 108, 66)))
    wood = Material(patterns.wood(rng, 128, 256, beech), 1.2, 0.6)
    frame = paint(pick(rng, ((60, 90, 130), (70, 74, 80), (170, 124, 76))))
    with stand.surfaces.thing("work_bench"):
        stand.box((-half, half), (0.0, 0.65), (0.82, 0.88), wood)
        for x in (-half + 0.03, half - 0.11):
            for y in (0.05, 0.52):
                stand.box((x, x + 0.08), (y, y + 0.08), (0.0, 0.82), frame)
        stand.box((-half + 0.05, half - 0.05), (0.08, 0.55), (0.2, 0.23), wood)
        unit = Material(laboratory.bench_unit(rng, 140, 160, pick(rng, ((200, 60, 40), STEEL))))
        stand.box((half - 0.56, half - 0.12), (0.1, 0.6), (0.42, 0.82), frame, front=unit)
        board = Material(laboratory.pegboard(rng, 200, int(400 * half)))
        stand.box((-half, half), (0.0, 0.03), (1.0, 1.75), frame, front=board)
        put_toolbox(stand, float(rng.uniform(-0.2, 0.2)), 0.22, 0.88)
        put_can(stand, half - 0.15, 0.2, 0.88)
        with stand.surfaces.thing("vice"):
            iron, x = paint(pick(rng, ((40, 80, 140), (60, 62, 66)))), -half + 0.25
            stand.box((x - 0.08, x + 0.08), (0.42, 0.62), (0.88, 0.93), iron)
            for y in (0.46, 0.64):
                stand.box((x - 0.07, x + 0.07), (y, y + 0.05), (0.93, 1.03), iron)
            tube(stand, (x, 0.5, 0.97), (x, 0.8, 0.97), 0.02, paint(STEEL))
            tube(stand, (x - 0.1, 0.78, 0.97), (x + 0.1, 0.78, 0.97), 0.009, paint(STEEL))
        with stand.surfaces.thing("hammer"):
            tube(stand, (0.1, 0.5, 0.9), (0.36, 0.42, 0.9), 0.014, paint((176, 130, 80)))
            stand.box((0.33, 0.37), (0.37, 0.49), (0.885, 0.92), paint((70, 72, 76)))
        put_carton(stand, (-half + 0.15, -half + 0.55), (0.12, 0.5), (0.23, 0.5))
