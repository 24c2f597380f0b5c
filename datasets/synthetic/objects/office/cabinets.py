"""Cabinets and shelves for files."""

from __future__ import annotations

from roomgraph.datasets.synthetic.objects.look import FABRICS, Look, paint
from roomgraph.datasets.synthetic.objects.office.shared import CASES, DARK, astray
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, office, patterns
from roomgraph.datasets.synthetic.textures.ink import VIVID

__all__ = ["filing_cabinet", "office_shelf"]


def filing_cabinet(stand: Stand, look: Look) -> None:
    """Build a steel cabinet with drawers, their handles and labels."""
    rng, count = stand.rng, int(stand.rng.integers(2, 5))
    half = float(rng.choice((0.21, 0.24, 0.4)))
    steel, tall = paint(patterns.pick(rng, CASES)), float(rng.uniform(0.3, 0.33))
    with stand.surfaces.thing("filing_cabinet"):
        stand.box((-half, half), (0.01, 0.58), (0.0, count * tall + 0.05), steel)
        for i in range(count):
            z = 0.04 + i * tall
            stand.box((-half + 0.012, half - 0.012), (0.58, 0.6), (z, z + tall - 0.015), steel)
            stand.picture((-half + 0.02, half - 0.02), (z - 0.012, z - 0.002), 0.583, DARK)
            stand.box(
                (-0.07, 0.07), (0.6, 0.625), (z + 0.55 * tall, z + 0.62 * tall), look.metallic()
            )
            label = Material(ink.sheet(rng, 30, 60))
            stand.picture((-0.045, 0.045), (z + 0.7 * tall, z + 0.83 * tall), 0.602, label)
        lock, z = paint((190, 192, 196)), count * tall
        tube(stand, (half - 0.04, 0.6, z), (half - 0.04, 0.608, z), 0.012, lock)
        if rng.random() < 0.6:
            box = stand.at(astray(rng, 0.05), 0.3, z + 0.05, astray(rng, 0.3))
            _archive_box(box)


def _archive_box(stand: Stand) -> None:
    """Put a cardboard box with a label and a lid down."""
    card = paint(patterns.pick(stand.rng, ((186, 146, 100), (206, 206, 200), (60, 84, 120))))
    stand.box((-0.15, 0.15), (-0.16, 0.16), (0, 0.21), card)
    stand.box((-0.155, 0.155), (-0.165, 0.165), (0.16, 0.22), card)
    stand.picture((-0.07, 0.07), (0.05, 0.13), 0.163, Material(ink.sheet(stand.rng, 50, 80)))


def office_shelf(stand: Stand, look: Look, width: float = 0.9) -> None:
    """Build a tall shelf with binders, books and boxes."""
    rng, wood, half = stand.rng, look.wooden(stand.rng), width / 2
    count = int(rng.integers(3, 7))
    pitch = float(rng.uniform(0.34, 0.37))
    with stand.surfaces.thing("book_case"):
        for x in (-half, half - 0.025):
            stand.box((x, x + 0.025), (0, 0.34), (0, 0.06 + count * pitch), wood)
        stand.box((-half, half), (0.0, 0.012), (0.05, count * pitch), wood)
        for i in range(count + 1):
            z = 0.06 + i * pitch
            stand.box((-half + 0.025, half - 0.025), (0.012, 0.335), (z - 0.025, z), wood)
            if i == count or rng.random() < 0.08:
                continue
            left, right = -half + 0.03, half - 0.03
            if right - left > 0.6 and rng.random() < 0.35:
                _archive_box(stand.at(right - 0.17, 0.17, z))
                right -= 0.34
            taste = VIVID if rng.random() < 0.6 else FABRICS
            row = office.books(rng, 90, int(270 * (right - left)), taste)
            stand.picture((left, right), (z, z + pitch - 0.035), 0.27, Material(row))
