"""Colours and materials of laboratory things."""

from __future__ import annotations

from roomgraph.datasets.synthetic.objects.look import paint
from roomgraph.datasets.synthetic.textures.patterns import Colour

DARK, PALE = paint((44, 46, 50)), paint((226, 228, 226))
STEEL, GLASS = paint((178, 182, 186)), paint((214, 226, 230))
UNITS: tuple[Colour, ...] = (
    (222, 224, 220), (168, 186, 194), (196, 186, 160), (120, 140, 160), (214, 206, 186),
)  # fmt: skip
TOPS: tuple[Colour, ...] = ((52, 54, 58), (74, 80, 84), (40, 42, 44))
