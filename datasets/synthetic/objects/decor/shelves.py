"""Shelves on walls, and books in stacks."""

from __future__ import annotations

from roomgraph.datasets.synthetic.objects.decor.colours import DARK, WHITE
from roomgraph.datasets.synthetic.objects.decor.pictures import photo_frame
from roomgraph.datasets.synthetic.objects.decor.plants import small_plant
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, office
from roomgraph.datasets.synthetic.textures.patterns import Colour, pick, plain

__all__ = ["book_stack", "wall_shelf"]


def wall_shelf(stand: Stand, look: Look) -> None:
    """Hang one or two boards with books, a plant, a photograph and a vase."""
    rng, half, wood = stand.rng, float(stand.rng.uniform(0.35, 0.55)), look.wooden(stand.rng)
    with stand.surfaces.thing("shelf"):
        for level in range(int(rng.integers(1, 3))):
            z = 1.35 + 0.38 * level
            stand.box((-half, half), (0.0, 0.22), (z - 0.025, z), wood)
            for x in (-0.7 * half, 0.7 * half):
                stand.box((x - 0.01, x + 0.01), (0.0, 0.16), (z - 0.09, z - 0.025), look.metallic())
            side = -1 if rng.random() < 0.5 else 1
            ends = sorted((side * (half - 0.02), side * (half - 0.42)))
            with stand.surfaces.thing("book"):
                spines = Material(office.books(rng, 90, 160, ink.VIVID))
                stand.box((ends[0], ends[1]), (0.03, 0.19), (z, z + 0.22), paint(WHITE),
                          front=spines)  # fmt: skip
            small_plant(stand.at(-side * (half - 0.1), 0.12, z), look)
            if half > 0.4:
                photo_frame(stand.at(-side * (half - 0.3), 0.15, z), look)


def book_stack(stand: Stand, look: Look) -> None:
    """Pile up books, each turned a little."""
    rng, z = stand.rng, 0.0
    for _ in range(int(rng.integers(2, 6))):
        a, b = float(rng.uniform(0.1, 0.15)), float(rng.uniform(0.08, 0.11))
        thick, colour = float(rng.uniform(0.015, 0.045)), pick(rng, ink.VIVID)
        spine, cover = plain(20, 120, colour), plain(120, 160, colour)
        title = f"{ink.word(rng)} {ink.word(rng)}"
        text: Colour = (246, 240, 220) if sum(colour) < 450 else DARK
        ink.write(spine, title, (10, 2, 110, 18), text)
        ink.write(cover, title.upper(), (14, 10, 146, 40), text)
        cover[50:110, 40:120] = ink.photo(rng, 60, 80)
        turned = stand.at(0.0, 0.0, z, float(rng.uniform(-0.4, 0.4)))
        with stand.surfaces.thing("book"):
            turned.box((-a, a), (-b, b), (0.0, thick), paint((236, 230, 212)),
                       front=Material(spine), top=Material(cover))  # fmt: skip
        z += thick
