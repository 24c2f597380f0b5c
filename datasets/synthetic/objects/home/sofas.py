"""Sofas and armchairs."""

from __future__ import annotations

from roomgraph.datasets.synthetic.objects.frames import panel, pipe
from roomgraph.datasets.synthetic.objects.look import Look
from roomgraph.datasets.synthetic.rendering.shapes import cushion, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand

__all__ = ["armchair", "sofa"]


def sofa(stand: Stand, look: Look) -> None:
    """Build a sofa for two or three: base, arms, back and loose cushions."""
    rng, fabric = stand.rng, look.woven(stand.rng)
    seats = int(rng.integers(2, 4))
    wide, arm, deep = 0.62, float(rng.uniform(0.12, 0.22)), float(rng.uniform(0.82, 0.95))
    half = seats * wide / 2
    with stand.surfaces.thing("sofa"):
        stand.box((-half, half), (0.05, deep - 0.04), (0.10, 0.30), fabric)
        for i in range(seats):
            x = -half + i * wide
            cushion(stand, (x + 0.01, x + wide - 0.01), (0.22, deep), (0.30, 0.44), fabric)
            cushion(stand, (x + 0.01, x + wide - 0.01), (0.10, 0.30), (0.42, 0.82), fabric)
        stand.box((-half, half), (0.0, 0.12), (0.10, 0.74), fabric)
        for x in (-half - arm, half):
            cushion(stand, (x, x + arm), (0.0, deep - 0.02), (0.08, 0.60), fabric, bevel=0.04)
        for x in (-half, half):
            for y in (0.08, deep - 0.1):
                tube(stand, (x, y, 0.10), (x, y, 0.0), 0.02, look.metallic())
        with stand.surfaces.thing("cushion"):
            pillow = look.woven(rng, second=True)
            x = half - 0.42 if rng.random() < 0.5 else -half + 0.04
            cushion(stand, (x, x + 0.38), (0.26, 0.40), (0.44, 0.78), pillow, bevel=0.06)


def armchair(stand: Stand, look: Look) -> None:
    """Build an easy chair: upholstered with thick arms, or cushions in a wooden frame."""
    rng, fabric = stand.rng, look.woven(stand.rng, second=True)
    half, framed = float(rng.uniform(0.27, 0.31)), bool(rng.random() < 0.45)
    top = float(rng.uniform(0.82, 1.02))
    wood, arm = look.wooden(rng), 0.06 if framed else float(rng.uniform(0.11, 0.18))
    with stand.surfaces.thing("armchair"):
        stand.footprint((-half - arm, half + arm), (-0.40, 0.40))
        panel(stand, [(half, -0.26, 0.36), (half, -0.42, top)], 0.04, 0.14, fabric)
        cushion(stand, (-half, half), (-0.24, 0.38), (0.29, 0.45), fabric, bevel=0.04)
        for x0, x1 in ((-half - arm, -half), (half, half + arm)):
            if framed:
                x = (x0 + x1) / 2
                pipe(stand, [(x, 0.36, 0.58), (x, 0.33, 0.0)], 0.02, wood)
                pipe(stand, [(x, -0.42, 0.0), (x, -0.28, 0.55)], 0.02, wood)
                stand.box((x0, x1), (-0.36, 0.40), (0.57, 0.60), wood)
                stand.box((x - 0.012, x + 0.012), (-0.32, 0.35), (0.25, 0.31), wood)
                continue
            cushion(stand, (x0, x1), (-0.38, 0.37), (0.13, 0.60), fabric)
            for y in (-0.33, 0.31):
                x = (x0 + x1) / 2
                tube(stand, (x, y, 0.15), (x * 1.06, y * 1.08, 0.0), (0.025, 0.014), wood)
        if framed:
            stand.box((-half, half), (0.31, 0.34), (0.24, 0.30), wood)
            return
        stand.box((-half, half), (-0.34, 0.34), (0.13, 0.30), fabric)
        if rng.random() < 0.5:
            with stand.surfaces.thing("cushion"):
                pillow = look.woven(rng)
                cushion(stand, (-0.2, 0.2), (-0.16, -0.02), (0.44, 0.76), pillow, bevel=0.06)
