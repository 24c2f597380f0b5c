"""What office things have in common: colours, and that nothing stands quite straight."""

from __future__ import annotations

import numpy as np

from roomgraph.datasets.synthetic.objects.look import paint
from roomgraph.datasets.synthetic.textures.patterns import Colour

DARK, PALE = paint((42, 43, 47)), paint((222, 222, 217))
CASES: tuple[Colour, ...] = ((222, 222, 217), (176, 178, 180), (70, 74, 80), (206, 200, 184))


def astray(rng: np.random.Generator, most: float) -> float:
    """Draw by how much something is off, either way."""
    return float(rng.uniform(-most, most))
