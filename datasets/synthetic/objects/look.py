"""The look of a room's furniture: colours that go together, drawn once a room."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roomgraph.datasets.synthetic.rendering.mesh import Glow, Material
from roomgraph.datasets.synthetic.textures import patterns
from roomgraph.datasets.synthetic.textures.patterns import Colour

WOODS: tuple[Colour, ...] = (
    (156, 104, 60), (206, 178, 136), (98, 66, 46), (186, 140, 92), (222, 210, 190), (64, 48, 40),
    (238, 236, 230), (128, 122, 116),
)  # fmt: skip
FABRICS: tuple[Colour, ...] = (
    (110, 112, 118), (168, 156, 138), (60, 72, 100), (130, 60, 50), (76, 96, 76), (52, 50, 54),
    (190, 170, 120), (150, 130, 150), (214, 206, 194), (40, 100, 110),
)  # fmt: skip
FRONTS: tuple[Colour, ...] = (
    (240, 240, 236), (222, 214, 196), (182, 132, 84), (150, 176, 160), (92, 104, 120),
    (206, 196, 190), (58, 60, 64), (120, 80, 52),
)  # fmt: skip
METALS: tuple[Colour, ...] = ((176, 180, 184), (44, 45, 48), (210, 212, 214), (150, 120, 70))
# How a screen shines that is on.
SCREEN_GLOW: Glow = (0.4, 0.0, 1.0, 0.9)


@dataclass(frozen=True, slots=True)
class Look:
    """Colours of one room's things: wood, two fabrics, cupboard fronts, metal, an accent.

    `grained` tells whether wooden things show their grain or are painted.
    """

    wood: Colour
    fabric: Colour
    fabric2: Colour
    front: Colour
    metal: Colour
    accent: Colour
    grained: bool

    def wooden(self, rng: np.random.Generator) -> Material:
        """Return the wood as a material for `Stand.box` and its kin."""
        if not self.grained:
            return Material(patterns.plaster(rng, 64, 64, self.wood), 1.0, 1.0)
        return Material(patterns.wood(rng, 160, 320, self.wood, 0.8), 1.2, 0.6)

    def woven(self, rng: np.random.Generator, second: bool = False) -> Material:
        """Return the fabric as a material."""
        return Material(patterns.cloth(rng, 120, 120, self.fabric2 if second else self.fabric))

    def metallic(self) -> Material:
        """Return the metal as a material that a depth camera still sees."""
        return Material(patterns.plain(16, 16, self.metal), 8.0, 8.0)


def draw_look(rng: np.random.Generator) -> Look:
    """Draw a look."""
    return Look(
        wood=patterns.pick(rng, WOODS), fabric=patterns.pick(rng, FABRICS),
        fabric2=patterns.pick(rng, FABRICS, 20), front=patterns.pick(rng, FRONTS),
        metal=patterns.pick(rng, METALS, 6), accent=patterns.pick(rng, FABRICS, 40),
        grained=bool(rng.random() < 0.75),
    )  # fmt: skip


def paint(colour: Colour) -> Material:
    """Return a material of one colour."""
    return Material(patterns.plain(16, 16, colour), 8.0, 8.0)
