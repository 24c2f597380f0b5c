"""What stands on a worktop."""

from __future__ import annotations

from roomgraph.datasets.synthetic.objects.kitchen.bottles import bottle
from roomgraph.datasets.synthetic.objects.kitchen.crockery import bowl, cup, fruit_bowl
from roomgraph.datasets.synthetic.objects.kitchen.shared import DARK
from roomgraph.datasets.synthetic.objects.kitchen.small_appliances import (
    coffee_machine,
    kettle,
    microwave,
    toaster,
)
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.shapes import block, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures.patterns import Generator


def draw_things(rng: Generator) -> list[str]:
    """Draw what stands on a worktop, in an order; a unit has room for one."""
    names = ["kettle", "toaster", "microwave", "coffee", "knives", "bottles", "fruit", "cups"]
    return [names[k] for k in rng.permutation(len(names))[: int(rng.integers(1, 5))]]


def put_thing(stand: Stand, look: Look, unit: float, name: str) -> None:
    """Put a thing, or a group of small ones, on a unit's worktop."""
    turn = float(stand.rng.uniform(-0.25, 0.25))
    if name == "microwave" and unit > 0.5:
        microwave(stand.at(0, 0.25), look)
    elif name == "bottles":
        for x in (-0.12, 0.0, 0.1):
            bottle(stand.at(x, 0.14 + 0.3 * abs(x)), look)
    elif name == "fruit":
        fruit_bowl(stand.at(0, 0.28, 0, turn), look)
    elif name == "cups":
        bowl(stand.at(0.1, 0.2), look)
        cup(stand.at(-0.12, 0.36, 0, turn), look)
    elif name == "knives":
        _knife_block(stand.at(0.0, 0.2, 0, turn), look)
    else:
        models = {"kettle": kettle, "toaster": toaster, "coffee": coffee_machine}
        models.get(name, kettle)(stand.at(0, 0.25, 0, turn), look)


def _knife_block(stand: Stand, look: Look) -> None:
    with stand.surfaces.thing("knife_block"):
        lower = [(-0.06, 0.06, 0.0), (0.06, 0.06, 0.0), (0.06, -0.1, 0.0), (-0.06, -0.1, 0.0)]
        upper = [(-0.06, 0.02, 0.15), (0.06, 0.02, 0.15), (0.06, -0.11, 0.23), (-0.06, -0.11, 0.23)]
        block(stand, upper, lower, paint((166, 116, 66)))
        for i in range(6):
            x, y = -0.035 + 0.035 * (i % 3), (-0.08 if i < 3 else -0.02)
            z = 0.21 if i < 3 else 0.175
            tube(stand, (x, y, z), (x, y + 0.06, z + 0.09), 0.011, DARK, sides=4)
