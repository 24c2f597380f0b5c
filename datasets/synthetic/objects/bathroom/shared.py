"""What bathroom things have in common: colours, mixer taps, bottles of shampoo."""

from __future__ import annotations

from roomgraph.datasets.synthetic.objects.kitchen.bottles import flask
from roomgraph.datasets.synthetic.objects.look import paint
from roomgraph.datasets.synthetic.rendering.shapes import tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, patterns
from roomgraph.datasets.synthetic.textures.patterns import Colour

WHITE, PALE, CHROME = paint((242, 244, 244)), paint((222, 226, 228)), paint((192, 197, 202))
DARK = paint((44, 46, 50))
TOWELS: tuple[Colour, ...] = (
    (236, 232, 224), (60, 110, 160), (190, 80, 80), (120, 160, 130), (230, 190, 90), (90, 90, 100),
)  # fmt: skip


def mixer_tap(stand: Stand) -> None:
    """Add a bath's mixer tap on the wall: a bar, two knobs, a spout."""
    tube(stand, (-0.11, 0.05, 0), (0.11, 0.05, 0), 0.022, CHROME)
    for x in (-0.14, 0.11):
        tube(stand, (x, 0.05, 0), (x + 0.03, 0.05, 0), 0.034, CHROME)
    tube(stand, (0, 0.05, -0.01), (0, 0.17, -0.03), 0.018, CHROME)


def shampoo(stand: Stand) -> None:
    """Put down a bottle of shampoo or soap."""
    rng = stand.rng
    colours = patterns.pick(rng, ink.VIVID, 30), patterns.pick(rng, ((244, 240, 230), (60, 60, 70)))
    with stand.surfaces.thing("bottle"):
        tall, wide = float(rng.uniform(0.14, 0.24)), float(rng.uniform(0.025, 0.038))
        flask(stand, tall, wide, colours, patterns.pick(rng, ink.VIVID))
