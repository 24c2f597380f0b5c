"""Colours that several files of this package share."""

from __future__ import annotations

from roomgraph.datasets.synthetic.textures.patterns import Colour

DARK, STEEL, WHITE = (34, 34, 38), (168, 172, 178), (240, 240, 236)
GREENS: tuple[Colour, ...] = ((58, 120, 52), (84, 146, 66), (44, 98, 48), (110, 156, 80))
