"""Flat boxes with a picture on them, and the colours of corridor fittings."""

from __future__ import annotations

from roomgraph.datasets.synthetic.rendering.mesh import Glow, Material
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures.patterns import Colour

WHITE, STEEL, DARK = (238, 238, 234), (170, 174, 178), (36, 36, 40)
SIGN_GLOW: Glow = (0.4, 0.2, 1.0, 0.8)
LEATHERS: tuple[Colour, ...] = ((44, 36, 34), (110, 68, 42), (232, 230, 226), (60, 74, 110))


def hang_panel(
    stand: Stand, width: float, z: tuple[float, float], face: Material, rim: Material,
    deep: float = 0.03,
) -> None:  # fmt: skip
    """Hang a flat box with a picture on its front."""
    stand.box((-width / 2, width / 2), (0.0, deep), z, rim, front=face)
