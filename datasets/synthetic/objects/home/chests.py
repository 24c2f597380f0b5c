"""Chests with drawers: nightstands and dressers, and what stands on them."""

from __future__ import annotations

from roomgraph.datasets.synthetic.objects.home.laid import put_vase
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.lighting import EVENING
from roomgraph.datasets.synthetic.rendering.mesh import Lamp, Material
from roomgraph.datasets.synthetic.rendering.shapes import lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Span, Stand
from roomgraph.datasets.synthetic.textures import ink, patterns

__all__ = ["dresser", "nightstand"]


def front_leaf(stand: Stand, x: Span, z: Span, y: float, face: Material, knob: Material) -> None:
    """Build a drawer's front with a knob, two knobs or, if it is wide, a bar."""
    stand.box((x[0] + 0.006, x[1] - 0.006), (y, y + 0.018), (z[0] + 0.006, z[1] - 0.006), face)
    # Off the middle, where the baked light has a sample that the knob would darken.
    middle, up = (x[0] + x[1]) / 2, z[0] + 0.63 * (z[1] - z[0])
    for share in (-0.25, 0.25) if x[1] - x[0] > 0.55 else (0.0,):
        at = middle + share * (x[1] - x[0])
        tube(stand, (at, y + 0.018, up), (at, y + 0.042, up), (0.009, 0.017), knob, sides=5)


def _table_lamp(stand: Stand, look: Look) -> None:
    """Build a lamp with a turned foot and a shade of cloth; it burns in the evening."""
    rng, foot = stand.rng, paint(look.accent) if stand.rng.random() < 0.5 else look.metallic()
    image = patterns.cloth(rng, 32, 32, patterns.pick(rng, ((250, 228, 178), (244, 236, 214))))
    shade = Material(image, glow=(0.35, 0.2, 1.4, 0.6))
    with stand.surfaces.thing("lamp"):
        base = [(0.06, 0.0), (0.06, 0.015), (0.02, 0.03), (0.05, 0.10), (0.015, 0.20)]
        lathe(stand, (0, 0), base, foot, sides=8)
        wide = float(rng.uniform(0.10, 0.13))
        lathe(stand, (0, 0), [(wide, 0.19), (0.62 * wide, 0.36), (0.01, 0.361)], shade, sides=10)
    for z, up, power in ((0.48, 1, 1.2), (0.17, -1, 0.5)):
        x, y, height = (float(v) for v in stand.world([(0, 0, z)])[0])
        stand.surfaces.lamps.append(Lamp((x, y, height), (0, 0, up), power, EVENING))


def _alarm_clock(stand: Stand) -> None:
    """Build an alarm clock with red digits."""
    image = patterns.plain(40, 80, (16, 16, 18))
    hour, minute = int(stand.rng.integers(24)), int(stand.rng.integers(60))
    ink.write(image, f"{hour:02}:{minute:02}", (8, 7, 72, 33), (250, 60, 40), thickness=2)
    with stand.surfaces.thing("clock"):
        face = Material(image, glow=(0.4, 0.1, 1.0, 0.7))
        stand.box((-0.06, 0.06), (-0.03, 0.03), (0.0, 0.06), paint((30, 30, 32)), front=face)


def nightstand(stand: Stand, look: Look) -> None:
    """Build a nightstand with one to three drawers, a lamp, perhaps a clock and a book."""
    rng, wood, knob = stand.rng, look.wooden(stand.rng), look.metallic()
    half, deep, high = (float(v) for v in rng.uniform((0.2, 0.36, 0.46), (0.26, 0.42, 0.6)))
    count, foot = int(rng.integers(1, 4)), float(rng.uniform(0.1, 0.18))
    low = high - 0.17 if count == 1 else foot
    with stand.surfaces.thing("nightstand"):
        stand.box((-half, half), (0.01, deep - 0.02), (low, high), wood)
        stand.box((-half - 0.01, half + 0.01), (0.01, deep), (high, high + 0.02), wood)
        for x in (0.02 - half, half - 0.02):
            for y in (0.03, deep - 0.04):
                stand.box((x - 0.018, x + 0.018), (y - 0.018, y + 0.018), (0.0, low), wood)
        if count == 1:
            stand.box((-half, half), (0.02, deep - 0.03), (0.14, 0.16), wood)
        for i in range(count):
            z = low + (high - low) * i / count, low + (high - low) * (i + 1) / count
            front_leaf(stand, (-half, half), z, deep - 0.02, wood, knob)
        _table_lamp(stand.at(-0.06, 0.15, high + 0.02), look)
        if rng.random() < 0.6:
            _alarm_clock(stand.at(half - 0.09, 0.12, high + 0.02, -0.2))
        if rng.random() < 0.6:
            cover = Material(ink.poster(rng, 90, 64))
            with stand.surfaces.thing("book"):
                book = stand.at(half - 0.11, deep - 0.11, high + 0.02, 0.3)
                page = paint((232, 226, 212))
                book.box((-0.065, 0.065), (-0.09, 0.09), (0.0, 0.028), page, top=cover)


def dresser(stand: Stand, look: Look) -> None:
    """Build a chest of drawers in one to three columns, with a few things on it."""
    rng, wood, knob = stand.rng, look.wooden(stand.rng), look.metallic()
    columns, rows = int(rng.integers(1, 4)), int(rng.integers(3, 5))
    half, deep, high = max(0.38, 0.26 * columns), 0.46, 0.24 * rows + float(rng.uniform(0, 0.08))
    face = paint(look.front) if rng.random() < 0.3 else wood
    with stand.surfaces.thing("dresser"):
        for x in (0.03 - half, half - 0.03):
            for y in (0.04, deep - 0.05):
                tube(stand, (x, y, 0.12), (x * 1.01, y, 0.0), (0.024, 0.016), wood)
        stand.box((-half, half), (0.012, deep - 0.02), (0.10, high), wood)
        stand.box((-half - 0.015, half + 0.015), (0.012, deep + 0.01), (high, high + 0.025), wood)
        for i in range(columns):
            for k in range(rows):
                left, right = (half * (2 * n / columns - 1) for n in (i, i + 1))
                z = tuple(0.10 + (high - 0.10) * n / rows for n in (k, k + 1))
                front_leaf(stand, (left, right), (z[0], z[1]), deep - 0.02, face, knob)
        if rng.random() < 0.5:
            put_vase(stand.at(0.25 - half, 0.2, high + 0.025))
        else:
            _table_lamp(stand.at(0.2 - half, 0.2, high + 0.025), look)
        frame = stand.at(half - 0.2, 0.12, high + 0.025, 0.2)
        photo = Material(ink.framed(ink.photo(rng, 90, 70), (60, 50, 44), 7))
        with stand.surfaces.thing("photo"):
            frame.box((-0.09, 0.09), (-0.01, 0.012), (0.0, 0.24), paint((60, 50, 44)), front=photo)
