"""What one person looks like: build, skin, hair and clothes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roomgraph.datasets.synthetic.people import clothes
from roomgraph.datasets.synthetic.rendering.mesh import Image, Material
from roomgraph.datasets.synthetic.textures import patterns
from roomgraph.datasets.synthetic.textures.patterns import Colour

TIGHTS: Colour = (46, 44, 48)


@dataclass(frozen=True, slots=True, eq=False)
class Outfit:
    """A person's build and materials.

    Attributes
    ----------
    height_m, girth, breadth, leg_width : float
        The height; how stout, how broad in the shoulders, how wide the trousers are (1: medium).
    woman, coat, bare_legs : bool
        Build; whether the drape is a coat, not a skirt; whether the legs are thin as without
        trousers.
    top, sleeve, legs, shoe, skin, head, nose : Material
        What the parts are covered with.
    drape : Material or None
        A skirt or the lower part of a coat, `drape_m` long.
    hair : Material or None
        Hair with a body of its own, down to `hair_to_m` above the chin.
    backpack : Material or None
        A backpack.
    """

    height_m: float
    girth: float
    breadth: float
    leg_width: float
    woman: bool
    coat: bool
    bare_legs: bool
    top: Material
    sleeve: Material
    legs: Material
    shoe: Material
    skin: Material
    head: Material
    nose: Material
    drape: Material | None
    drape_m: float
    hair: Material | None
    hair_to_m: float
    backpack: Material | None


def draw_outfit(rng: np.random.Generator) -> Outfit:
    """Draw what a person looks like."""
    woman = bool(rng.random() < 0.5)
    skin, hair = patterns.pick(rng, clothes.SKINS, 8), patterns.pick(rng, clothes.HAIRS, 8)
    coat = bool(rng.random() < 0.2)
    skirt = woman and not coat and bool(rng.random() < 0.35)
    top, sleeve, drape = _upper(rng, skin, coat)
    legs = _lower(rng, skin, skirt)
    bald = not woman and bool(rng.random() < 0.2)
    lengths = (-0.10, -0.02, 0.05) if woman else (0.06, 0.08)
    middle = 1.66 if woman else 1.78
    if skirt:
        colour = patterns.pick(rng, clothes.BOTTOMS + clothes.TOPS)
        drape = _material(clothes.cloth(rng, "plain", (128, 256), colour, colour))
    face = clothes.face(rng, skin, hair, woman, float(rng.uniform(0.80, 0.86)))
    tone = patterns.tint(skin, 0.05 * patterns.noise(rng, 32, 32, (12, 12)))
    return Outfit(
        height_m=float(np.clip(rng.normal(middle, 0.065), 1.55, 1.92)),
        girth=float(rng.uniform(0.90, 1.20)), breadth=float(rng.uniform(0.94, 1.08)),
        leg_width=float(rng.uniform(0.85, 1.25)), woman=woman, coat=coat, bare_legs=skirt,
        top=_material(top), sleeve=_material(sleeve), legs=_material(legs),
        shoe=_material(_shoe(rng)), skin=_material(tone), head=_material(face),
        nose=_material(patterns.plain(8, 8, patterns.shift(rng, skin, 4))),
        drape=drape if skirt or coat else None,
        drape_m=float(rng.uniform(0.32, 0.5) if skirt else rng.uniform(0.22, 0.42)),
        hair=None if bald else _material(clothes.hair_image(rng, hair)),
        hair_to_m=float(rng.choice(lengths)),
        backpack=_backpack(rng) if rng.random() < 0.3 and not (skirt or coat) else None,
    )  # fmt: skip


def _material(image: Image) -> Material:
    return Material(image)


def _upper(
    rng: np.random.Generator, skin: Colour, coat: bool
) -> tuple[Image, Image, Material | None]:
    """Return the images of the trunk and a sleeve, and a coat's skirts."""
    colour, other = patterns.pick(rng, clothes.TOPS, 16), patterns.pick(rng, clothes.TOPS, 16)
    kind = "plain" if coat else str(rng.choice(clothes.PATTERNS))
    body = clothes.cloth(rng, kind, (160, 256), colour, other)
    sleeve = clothes.cloth(rng, kind, (160, 96), colour, other)
    style = "jacket" if coat else str(rng.choice(["jacket", "shirt", "tee", "jumper"]))
    if style == "jacket":
        tie = patterns.pick(rng, clothes.TOPS) if rng.random() < 0.3 else None
        shirt = patterns.pick(rng, ((232, 232, 230), (190, 206, 226), (120, 120, 124)))
        body = clothes.open_front(body, shirt, tie, skin)
    elif style == "shirt":
        body = clothes.neckline(clothes.buttoned(body, sum(colour) > 400), skin, 0.10)
    else:
        body = clothes.neckline(body, skin, 0.11)
    if style == "tee":
        sleeve = clothes.limb(rng, sleeve, skin, 0.34)
    drape = _material(clothes.cloth(rng, kind, (96, 256), colour, other)) if coat else None
    return body, sleeve, drape


def _lower(rng: np.random.Generator, skin: Colour, skirt: bool) -> Image:
    """Return the image of a leg: trousers, or tights or skin below a skirt."""
    if skirt:
        colour = TIGHTS if rng.random() < 0.5 else skin
        return patterns.tint(colour, 0.05 * patterns.noise(rng, 128, 96, (30, 20)))
    colour = patterns.pick(rng, clothes.BOTTOMS)
    kind = "jeans" if colour[2] > colour[0] + 12 else "plain"
    return clothes.cloth(rng, kind, (192, 96), colour, colour)


def _shoe(rng: np.random.Generator) -> Image:
    """Return a shoe's image: the upper, and a sole below."""
    image = patterns.cloth(rng, 48, 96, patterns.pick(rng, clothes.SHOES))
    image[40:] = patterns.pick(rng, ((40, 40, 42), (222, 222, 218), (120, 90, 60)))
    return image


def _backpack(rng: np.random.Generator) -> Material:
    """Return a backpack's image with its pocket and zips."""
    colour = patterns.pick(rng, clothes.TOPS)
    image = clothes.cloth(rng, "plain", (96, 160), colour, colour)
    image[30:33] = (30, 30, 32)
    image[60:62] = (30, 30, 32)
    return _material(image)
