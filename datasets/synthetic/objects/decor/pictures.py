"""Pictures, posters and photographs in frames."""

from __future__ import annotations

from roomgraph.datasets.synthetic.objects.decor.colours import DARK, STEEL, WHITE
from roomgraph.datasets.synthetic.objects.look import WOODS, Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Image, Material
from roomgraph.datasets.synthetic.rendering.shapes import block
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink
from roomgraph.datasets.synthetic.textures.patterns import Colour, pick

__all__ = ["photo_frame", "picture", "poster"]


def _framed(stand: Stand, image: Image, width: float, middle: float, rim: Material) -> None:
    """Hang a picture with a frame that stands out, its middle at a height."""
    half, tall = width / 2, width * image.shape[0] / image.shape[1] / 2
    z = middle - tall, middle + tall
    stand.box((-half, half), (0.0, 0.018), z, rim, front=Material(image))
    bar = 0.02 + 0.02 * width
    for x in (-half - bar, half):
        stand.box((x, x + bar), (0.0, 0.03), (z[0] - bar, z[1] + bar), rim)
    for up in (z[0] - bar, z[1]):
        stand.box((-half, half), (0.0, 0.03), (up, up + bar), rim)


def picture(stand: Stand, look: Look, *, width: float = 0.6) -> None:
    """Hang a framed picture with a white mount, upright or across."""
    rng = stand.rng
    height, across = (180, 240) if rng.random() < 0.6 else (240, 180)
    image = ink.photo(rng, height, across)
    if rng.random() < 0.6:
        image = ink.framed(image, (240, 238, 230), 24)
    rim = paint(pick(rng, ((186, 148, 70), DARK, WHITE, *WOODS[:4])))
    with stand.surfaces.thing("picture"):
        _framed(stand, image, width if across > height else 0.75 * width, 1.55, rim)


def poster(stand: Stand, look: Look) -> None:
    """Hang a poster without a frame."""
    rng = stand.rng
    image = ink.poster(rng, 340, 240) if rng.random() < 0.6 else ink.photo(rng, 340, 240)
    wide = float(rng.uniform(0.42, 0.62))
    with stand.surfaces.thing("poster"):
        z = float(rng.uniform(1.05, 1.2))
        stand.picture((-wide / 2, wide / 2), (z, z + 1.417 * wide), 0.014, Material(image))


def photo_frame(stand: Stand, look: Look) -> None:
    """Build a small frame with a photograph that leans back."""
    rng, across = stand.rng, bool(stand.rng.random() < 0.5)
    half, tall = (0.1, 0.16) if across else (0.075, 0.21)
    image = ink.framed(ink.photo(rng, int(800 * tall), int(1600 * half)), (242, 240, 234), 10)
    rim: Colour = pick(rng, ((186, 148, 70), DARK, STEEL, (150, 100, 60)))
    face, lean = Material(ink.framed(image, rim, 12)), -0.25 * tall
    with stand.surfaces.thing("photo_frame"):
        top = [(-half, lean + 0.03, tall), (half, lean + 0.03, tall), (half, lean + 0.012, tall),
               (-half, lean + 0.012, tall)]  # fmt: skip
        foot = [(-half, 0.03, 0.0), (half, 0.03, 0.0), (half, 0.012, 0.0), (-half, 0.012, 0.0)]
        block(stand, top, foot, paint(rim))
        front = [top[0], top[1], foot[1], foot[0]]
        stand.surfaces.picture(stand.world([(x, y + 0.002, z) for x, y, z in front]), face)
        stand.box((-0.015, 0.015), (2.4 * lean, lean), (0.0, 0.008), paint(DARK))
        stand.footprint((-half, half), (lean, 0.03))
