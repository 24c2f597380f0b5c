"""What lies and stands on tables that are in use."""

from __future__ import annotations

import numpy as np

from roomgraph.datasets.synthetic.objects.look import SCREEN_GLOW, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import block, lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, office, patterns
from roomgraph.datasets.synthetic.textures.patterns import Colour

FRUIT: tuple[Colour, ...] = ((210, 40, 36), (240, 140, 30), (150, 180, 50), (240, 210, 60))
PETALS: tuple[Colour, ...] = ((220, 60, 70), (240, 200, 60), (240, 236, 240), (180, 90, 170))
GLAZES: tuple[Colour, ...] = ((236, 234, 228), (60, 90, 120), (150, 70, 50), (90, 120, 100))


def put_vase(stand: Stand) -> None:
    """Build a vase with a bunch of flowers."""
    rng, glaze = stand.rng, paint(patterns.pick(stand.rng, GLAZES))
    tall = float(rng.uniform(0.16, 0.24))
    profile = [(0.04, 0.0), (0.07, 0.4 * tall), (0.035, 0.85 * tall), (0.05, tall)]
    petal, leaf = paint(patterns.pick(rng, PETALS)), paint(patterns.shift(rng, (60, 110, 50)))
    with stand.surfaces.thing("vase"):
        lathe(stand, (0, 0), profile, glaze, sides=8)
        for angle in np.arange(4) * np.pi / 2 + 0.4:
            out = float(rng.uniform(0.04, 0.12))
            x, y = out * float(np.cos(angle)), out * float(np.sin(angle))
            z = tall + float(rng.uniform(0.09, 0.18))
            tube(stand, (0, 0, 0.8 * tall), (x, y, z), (0.004, 0.012), leaf, sides=3)
            bloom = [(0.004, z - 0.02), (0.038, z + 0.008), (0.004, z + 0.03)]
            lathe(stand, (x, y), bloom, petal, sides=5)


def put_fruit_bowl(stand: Stand) -> None:
    """Build a bowl of fruit."""
    rng, glaze = stand.rng, paint(patterns.pick(stand.rng, GLAZES))
    with stand.surfaces.thing("bowl"):
        profile = [(0.06, 0.0), (0.14, 0.07), (0.13, 0.07), (0.004, 0.05)]
        lathe(stand, (0, 0), profile, glaze, sides=10)
        for angle in np.arange(5) * 2 * np.pi / 5:
            x, y = 0.07 * float(np.cos(angle)), 0.07 * float(np.sin(angle))
            ball = [(0.015, 0.03), (0.043, 0.068), (0.03, 0.095), (0.002, 0.105)]
            lathe(stand, (x, y), ball, paint(patterns.pick(rng, FRUIT)), sides=5)


def lay_plate(stand: Stand, cup: bool) -> None:
    """Lay a place: a plate with a knife and a fork, perhaps a cup."""
    glaze, steel = paint((238, 238, 234)), paint((170, 174, 178))
    rim = [(0.07, 0.0), (0.125, 0.018), (0.08, 0.008), (0.002, 0.007)]
    lathe(stand, (0, 0), rim, glaze, sides=10)
    for x in (-0.165, 0.16):
        stand.box((x, x + 0.014), (-0.09, 0.1), (0.0, 0.005), steel)
    if cup:
        mug = [(0.03, 0.0), (0.04, 0.09), (0.034, 0.09), (0.002, 0.02)]
        lathe(stand, (0.17, -0.19), mug, paint(patterns.pick(stand.rng, GLAZES)), sides=8)


def lay_papers(stand: Stand, turn: float) -> None:
    """Lay a few sheets of print and a pen down."""
    leaf = stand.at(0, 0, 0, turn)
    for x in (0.0, 0.05):
        sheet = Material(ink.sheet(stand.rng, 90, 64))
        leaf.sheet((x - 0.105, x + 0.105), (-0.15, 0.15), 0.003 + 0.04 * x, sheet)
    tube(leaf, (0.18, -0.07, 0.006), (0.2, 0.07, 0.006), 0.005, paint((30, 40, 110)), sides=4)


def put_laptop(stand: Stand) -> None:
    """Build an open laptop."""
    grey = paint((150, 152, 156) if stand.rng.random() < 0.6 else (40, 40, 43))
    keys = office.keyboard(stand.rng, 60, 150)
    screen = Material(office.screen(stand.rng, 110, 170), glow=SCREEN_GLOW)
    with stand.surfaces.thing("laptop"):
        stand.box((-0.165, 0.165), (-0.11, 0.11), (0.0, 0.014), grey)
        stand.sheet((-0.15, 0.15), (-0.09, 0.03), 0.016, Material(keys))
        low = [(-0.165, -0.105, 0.016), (0.165, -0.105, 0.016)]
        high = [(-0.165, -0.165, 0.225), (0.165, -0.165, 0.225)]
        behind = [[(x, y - 0.008, z) for x, y, z in edge[::-1]] for edge in (high, low)]
        block(stand, [*high, *behind[0]], [*low, *behind[1]], grey)
        shown = [(x * 0.97, y + 0.003, z) for x, y, z in (high[0], high[1], low[1], low[0])]
        stand.surfaces.picture(stand.world(shown), screen)
