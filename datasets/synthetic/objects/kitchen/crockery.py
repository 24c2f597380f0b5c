"""Glazed crockery: cups, bowls, plates, tea pots, vases."""

from __future__ import annotations

import cv2
import numpy as np

from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, patterns
from roomgraph.datasets.synthetic.textures.patterns import Colour, Generator

__all__ = ["bowl", "cup", "fruit_bowl", "plate", "tea_pot", "vase"]

GLAZES: tuple[Colour, ...] = (
    (244, 243, 238), (238, 232, 216), (196, 48, 42), (40, 84, 150), (44, 120, 84), (226, 168, 36),
    (60, 62, 68), (120, 176, 184), (214, 120, 90),
)  # fmt: skip
FRUITS: tuple[Colour, ...] = ((226, 120, 24), (190, 40, 36), (130, 170, 50), (236, 200, 60))


def _glaze(rng: Generator, colour: Colour) -> Material:
    """Return glazed china: plain, with bands, or with a motif that goes round."""
    image = patterns.plaster(rng, 48, 120, colour)
    ink_colour = patterns.pick(rng, ink.VIVID)
    kind = int(rng.integers(4))
    if kind == 1:
        for y in (4, 36):
            cv2.rectangle(image, (0, y), (120, y + int(rng.integers(3, 8))), ink_colour, -1)
    elif kind == 2:
        for x in range(8, 120, 20):
            cv2.circle(image, (x, 22), int(rng.integers(4, 8)), ink_colour, -1, cv2.LINE_AA)
    elif kind == 3:
        cv2.rectangle(image, (0, 24), (120, 48), ink_colour, -1)
    return Material(image)


def _loop(
    stand: Stand, x: float, z: tuple[float, float], out: float, thick: float, material: Material
) -> None:
    """Add a handle: out from x, down, and back in."""
    low, high = z
    sides = 4
    tube(stand, (x, 0, high), (x + out, 0, high - 0.1 * out), thick, material, sides=sides)
    tube(stand, (x + out, 0, high), (x + out, 0, low + 0.2 * out), thick, material, sides=sides)
    tube(stand, (x + out, 0, low + 0.2 * out), (x, 0, low), thick, material, sides=sides)


def cup(stand: Stand, look: Look) -> None:
    """Build a mug or a tea cup on its saucer, with a drink in it."""
    rng = stand.rng
    china = _glaze(rng, patterns.pick(rng, GLAZES))
    tall, wide = (0.095, 0.042) if rng.random() < 0.6 else (0.065, 0.046)
    foot = 0.9 * wide if tall > 0.08 else 0.5 * wide
    with stand.surfaces.thing("cup"):
        z = 0.0
        if tall < 0.08:
            lathe(stand, (0, 0), [(0.04, 0), (0.075, 0.012)], china, sides=16)
            z = 0.006
        profile = [(foot, z), (wide, z + 0.5 * tall), (wide, z + tall), (wide - 0.005, z + tall)]
        lathe(stand, (0, 0), [*profile, (wide - 0.006, z + 0.75 * tall)], china, sides=16)
        tea = paint((72, 40, 22) if rng.random() < 0.6 else (236, 232, 224))
        lathe(stand, (0, 0), [(wide - 0.006, z + 0.755 * tall)] * 2, tea, sides=16)
        side = stand.at(0, 0, 0, float(rng.uniform(-0.7, 0.7)))
        _loop(side, wide - 0.004, (z + 0.22 * tall, z + 0.85 * tall), 0.028, 0.005, china)


def _dish(stand: Stand, wide: float, tall: float, china: Material) -> None:
    outside = [(0.45 * wide, 0.0), (0.8 * wide, 0.4 * tall), (wide, tall)]
    inside = [(0.95 * wide, tall), (0.74 * wide, 0.45 * tall), (0.4 * wide, 0.12 * tall)]
    lathe(stand, (0, 0), [*outside, *inside], china, sides=16)


def bowl(stand: Stand, look: Look) -> None:
    """Build an open bowl."""
    rng = stand.rng
    with stand.surfaces.thing("bowl"):
        china = _glaze(rng, patterns.pick(rng, GLAZES))
        _dish(stand, float(rng.uniform(0.07, 0.13)), float(rng.uniform(0.06, 0.09)), china)


def plate(stand: Stand, look: Look) -> None:
    """Build a plate with a coloured rim, sometimes with food on it."""
    rng, wide = stand.rng, float(stand.rng.uniform(0.10, 0.135))
    image = patterns.plain(60, 120, patterns.pick(rng, GLAZES[:2]))
    image[:14] = patterns.pick(rng, GLAZES)
    with stand.surfaces.thing("plate"):
        profile = [(0.6 * wide, 0.0), (wide, 0.020), (0.98 * wide, 0.022), (0.66 * wide, 0.010)]
        lathe(stand, (0, 0), profile, Material(image), sides=12)
        middle = Material(image[40:, :40])
        lathe(stand, (0, 0), [(0.66 * wide, 0.011)] * 2, middle, sides=12)
        for _ in range(int(rng.integers(0, 4))):
            at = float(rng.uniform(-0.04, 0.04)), float(rng.uniform(-0.04, 0.04))
            food = paint(patterns.pick(rng, (*FRUITS, (150, 90, 44))))
            lathe(stand, at, [(0.03, 0.011), (0.018, 0.035)], food, sides=6)


def fruit_bowl(stand: Stand, look: Look) -> None:
    """Build a bowl full of apples, oranges and bananas."""
    rng = stand.rng
    with stand.surfaces.thing("fruit_bowl"):
        basket = look.wooden(rng) if rng.random() < 0.4 else _glaze(rng, patterns.pick(rng, GLAZES))
        _dish(stand, 0.14, 0.075, basket)
        start = float(rng.uniform(0, 6))
        for i in range(4):
            angle, out = start + 2.1 * i, 0.062 if i < 3 else 0.0
            r, z = float(rng.uniform(0.034, 0.042)), 0.034 if i < 3 else 0.085
            x, y = float(out * np.cos(angle)), float(out * np.sin(angle))
            skin = paint(patterns.pick(rng, FRUITS[:3]))
            ball = [
                (0.4 * r, z),
                (r, z + 0.6 * r),
                (0.95 * r, z + 1.3 * r),
                (0.35 * r, z + 1.9 * r),
            ]
            lathe(stand, (x, y), ball, skin, sides=6)
        yellow = paint((240, 206, 60))
        for shift in (-0.015, 0.02):
            bends = [(-0.11, 1.0, 0.10), (-0.06, 1.6, 0.137), (0.02, 2.0, 0.145), (0.09, 1.0, 0.11)]
            arc = [(along, aside * shift, high) for along, aside, high in bends]
            tube(stand, arc[0], arc[1], (0.007, 0.017), yellow, sides=4)
            tube(stand, arc[1], arc[2], 0.017, yellow, sides=4)
            tube(stand, arc[2], arc[3], (0.017, 0.006), yellow, sides=4)


def vase(stand: Stand, look: Look) -> None:
    """Build a vase with a bunch of flowers."""
    rng, tall = stand.rng, float(stand.rng.uniform(0.18, 0.26))
    green = paint(patterns.pick(rng, ((60, 120, 50), (90, 140, 70))))
    petals = patterns.pick(
        rng, ((220, 60, 80), (240, 190, 50), (236, 236, 230), (150, 90, 190)), 20
    )
    with stand.surfaces.thing("vase"):
        w = float(rng.uniform(0.045, 0.065))
        profile = [(0.7 * w, 0), (w, 0.35 * tall), (0.5 * w, 0.8 * tall), (0.7 * w, tall)]
        lathe(stand, (0, 0), profile, _glaze(rng, patterns.pick(rng, GLAZES)), sides=10)
        with stand.surfaces.thing("flower"):
            for i in range(5):
                turn, out = i * 1.26 + float(rng.uniform(-0.3, 0.3)), 0.045 + 0.05 * (i % 2)
                x, y = float(out * np.cos(turn)), float(out * np.sin(turn))
                z = tall + 0.26 - 1.4 * out + float(rng.uniform(-0.02, 0.03))
                tube(stand, (0.2 * x, 0.2 * y, tall), (x, y, z), 0.003, green, sides=3)
                bloom = [(0.008, z - 0.006), (0.034, z + 0.018), (0.024, z + 0.028)]
                lathe(stand, (x, y), bloom, paint(patterns.shift(rng, petals, 16)), sides=6)
                core = [(0.013, z + 0.026), (0.008, z + 0.036)]
                lathe(stand, (x, y), core, paint((226, 170, 40)), sides=4)
                tip = (1.5 * x, 1.5 * y, tall + 0.08)
                tube(stand, (0.2 * x, 0.2 * y, tall), tip, (0.012, 0.002), green, sides=3)


def tea_pot(stand: Stand, look: Look) -> None:
    """Build a tea pot: round body, lid with a knob, spout, handle."""
    rng, china = stand.rng, _glaze(stand.rng, patterns.pick(stand.rng, GLAZES))
    w, tall = float(rng.uniform(0.075, 0.095)), float(rng.uniform(0.11, 0.15))
    with stand.surfaces.thing("tea_pot"):
        body = [(0.6 * w, 0), (w, 0.35 * tall), (0.95 * w, 0.65 * tall), (0.5 * w, tall)]
        lathe(stand, (0, 0), body, china, sides=10)
        lid = [(0.52 * w, tall), (0.2 * w, tall + 0.02), (0.18 * w, tall + 0.035)]
        lathe(stand, (0, 0), lid, china, sides=8)
        low, high = (-0.9 * w, 0, 0.35 * tall), (-1.75 * w, 0, 0.95 * tall)
        tube(stand, low, high, (0.022, 0.009), china)
        _loop(stand, 0.85 * w, (0.25 * tall, 0.82 * tall), 0.6 * w, 0.007, china)
