"""Colours and materials of kitchen machines."""

from __future__ import annotations

from roomgraph.datasets.synthetic.objects.look import paint
from roomgraph.datasets.synthetic.textures.patterns import Colour

STEEL, DARK = paint((190, 194, 198)), paint((40, 41, 45))
CASES: tuple[Colour, ...] = ((196, 200, 202), (44, 44, 48), (232, 230, 222), (180, 44, 40))
