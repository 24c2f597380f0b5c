"""Chairs: kinds of which a set is made, at a table or alone."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from roomgraph.datasets.synthetic.objects.frames import panel, pipe
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import block, cushion, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import patterns
from roomgraph.datasets.synthetic.textures.patterns import Colour

__all__ = ["dining_chair", "visitor_chair"]

SLATS, SPINDLES, UPHOLSTERED, SHELL, CANTILEVER, ARMS = range(6)
DINING, MEETING = (SLATS, SPINDLES, UPHOLSTERED, SHELL), (SHELL, CANTILEVER, ARMS)
SHELLS: tuple[Colour, ...] = (
    (240, 240, 238), (40, 42, 46), (210, 90, 50), (70, 120, 130), (226, 184, 60), (120, 150, 110),
)  # fmt: skip


@dataclass(frozen=True, slots=True, eq=False)
class ChairKind:
    """What chairs of one set have in common: style, sizes in metres, frame and cover."""

    style: int
    half: float
    top: float
    frame: Material
    cover: Material


def draw_chair(rng: np.random.Generator, look: Look, styles: Sequence[int]) -> ChairKind:
    """Draw a set's kind of chair, in one of some styles."""
    style = int(styles[int(rng.integers(len(styles)))])
    frame = look.metallic() if style in (CANTILEVER, ARMS) else look.wooden(rng)
    cover = look.woven(rng, second=rng.random() < 0.5)
    if style == SHELL:
        cover = paint(patterns.pick(rng, SHELLS))
    top = float(rng.uniform(0.86, 1.02) if style < SHELL else rng.uniform(0.80, 0.88))
    return ChairKind(style, float(rng.uniform(0.205, 0.235)), top, frame, cover)


def put_chair(stand: Stand, kind: ChairKind) -> None:
    """Build a chair of a kind, its seat centred on (0, 0)."""
    build = {SHELL: _shell_chair, CANTILEVER: _steel_chair, ARMS: _steel_chair}
    with stand.surfaces.thing("chair"):
        build.get(kind.style, _wooden_chair)(stand, kind)
        stand.footprint((-kind.half, kind.half), (-kind.half, kind.half))


def dining_chair(stand: Stand, look: Look) -> None:
    """Build a chair for the table: wooden with slats, spindles or a padded back, or a shell."""
    put_chair(stand, draw_chair(stand.rng, look, DINING))


def visitor_chair(stand: Stand, look: Look) -> None:
    """Build a chair for a waiting visitor: padded, on a frame of steel tube."""
    put_chair(stand.at(0.0, 0.33), draw_chair(stand.rng, look, (CANTILEVER, ARMS)))


def _wooden_chair(stand: Stand, kind: ChairKind) -> None:
    """Four legs, the hind ones run up into a back that leans a little."""
    half, top, frame = kind.half, kind.top, kind.frame
    rail = half - 0.02
    for x in (-rail, rail):
        tube(stand, (x, rail, 0.44), (x, rail, 0.0), (0.021, 0.015), frame)
        pipe(
            stand, [(x, -half - 0.03, 0.0), (x, -rail, 0.46), (x, -half - 0.06, top)], 0.018, frame
        )
        pipe(stand, [(x, -rail, 0.22), (x, rail, 0.22)], 0.01, frame)
    stand.box((-rail, rail), (-rail, rail), (0.37, 0.43), frame)
    soft = kind.style == UPHOLSTERED
    seat = kind.cover if soft else frame
    cushion(stand, (-half, half), (-half, half + 0.01), (0.43, 0.50 if soft else 0.46), seat)
    lean = -half - 0.02
    if soft:
        panel(stand, [(rail, lean, 0.54), (rail, lean - 0.05, top)], 0.01, 0.05, seat)
        return
    panel(stand, [(rail, lean - 0.035, top - 0.08), (rail, lean - 0.045, top)], 0.02, 0.02, frame)
    if kind.style == SPINDLES:
        for share in (-0.66, -0.33, 0.0, 0.33, 0.66):
            x = share * rail
            pipe(stand, [(x, -rail, 0.45), (x, lean - 0.03, top - 0.05)], 0.009, frame)
        return
    for z in np.linspace(0.56, top - 0.19, 2):
        share = 0.04 * (float(z) - 0.46) / (top - 0.46)
        levels = [(rail, lean - share, float(z)), (rail, lean - share, float(z) + 0.055)]
        panel(stand, levels, 0.02, 0.018, frame)


def _shell_chair(stand: Stand, kind: ChairKind) -> None:
    """Build a moulded seat and back on four slanting legs."""
    half, cover = kind.half, kind.cover
    for x in (-1, 1):
        for y in (-1, 1):
            foot = (x * (half + 0.01), y * (half + 0.01), 0.0)
            tube(stand, (x * 0.12, y * 0.12, 0.43), foot, (0.02, 0.012), kind.frame)
    pipe(stand, [(-0.14, 0.15, 0.3), (0.14, -0.15, 0.3)], 0.006, paint((40, 40, 42)))
    pipe(stand, [(0.14, 0.15, 0.3), (-0.14, -0.15, 0.3)], 0.006, paint((40, 40, 42)))
    for x0, x1, rise0, rise1 in ((-1, -0.5, 0.05, 0), (-0.5, 0.5, 0, 0), (0.5, 1, 0, 0.05)):
        shape = [(x0, 1, rise0), (x1, 1, rise1), (x1, -1, rise1), (x0, -1, rise0)]
        top = [(x * half, y * half, 0.445 + rise) for x, y, rise in shape]
        block(stand, top, [(x, y, z - 0.02) for x, y, z in top], cover)
    levels = [
        (half, -half - 0.01, 0.425), (half + 0.02, -half - 0.04, 0.60),
        (half - 0.01, -half - 0.07, kind.top - 0.06), (half - 0.08, -half - 0.085, kind.top),
    ]  # fmt: skip
    panel(stand, levels, 0.06, 0.016, cover)


def _steel_chair(stand: Stand, kind: ChairKind) -> None:
    """Build a padded chair of steel tube: without hind legs, or with four legs and arms."""
    half, top, frame = kind.half, kind.top, kind.frame
    for x in (-half - 0.02, half + 0.02):
        line = [(x, -half, 0.015), (x, half, 0.015), (x, half + 0.03, 0.05), (x, half, 0.44)]
        if kind.style == ARMS:
            line = [(x, -half, 0.0), (x, -half + 0.03, 0.66), (x, half - 0.02, 0.66), (x, half, 0)]
            arm = (x - 0.025, x + 0.025), (-half, half), (0.655, 0.685)
            cushion(stand, *arm, paint((40, 40, 43)), bevel=0.01)
            line.append((x, half, 0.43))
        back = [(x, -half + 0.02, 0.44), (x * 0.94, -half - 0.07, top)]
        pipe(stand, [*line, *back], 0.0125, frame)
    if kind.style == CANTILEVER:
        pipe(stand, [(-half, -half, 0.015), (half, -half, 0.015)], 0.0125, frame)
    cushion(stand, (-half - 0.01, half + 0.01), (-half + 0.02, half), (0.43, 0.50), kind.cover)
    low, high = (half - 0.01, -half - 0.03, 0.58), (half - 0.01, -half - 0.075, top + 0.01)
    panel(stand, [low, high], 0.015, 0.045, kind.cover)
