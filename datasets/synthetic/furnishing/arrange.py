"""Arranging a room: what its programme asks for is put where it fits."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from roomgraph.datasets.synthetic.furnishing.piece import Piece, make_piece
from roomgraph.datasets.synthetic.furnishing.plot import Placed, Plot, free_spans
from roomgraph.datasets.synthetic.furnishing.programmes import PROGRAMMES, SMALL, Item
from roomgraph.datasets.synthetic.objects.catalogue import package_of
from roomgraph.datasets.synthetic.objects.look import Look
from roomgraph.datasets.synthetic.rendering.mesh import FloatArray
from roomgraph.datasets.synthetic.rendering.stand import Stand

TRIES, NEEDED_TRIES = 18, 6
# Larger rooms than this have more of what they may have several of.
USUAL_M2 = 14.0
# Of a room's floor, at most this share is furnished.
FULLEST = 0.55
# A table's top: how high it may be, and how large it is at least.
TOP_M, TOP_AREA_M2 = (0.35, 1.15), 0.12
# A small thing is put this far from what is on the table already.
SMALL_APART_M = 0.18


@dataclass(frozen=True, slots=True, eq=False)
class Arranger:
    """Puts pieces into a plot.

    Attributes
    ----------
    plot : Plot
    look : Look
        The room's colours.
    seed : tuple of int
        From it every piece has random numbers of its own: one change does not change the rest.
    """

    plot: Plot
    look: Look
    seed: tuple[int, ...]

    def furnish(self) -> list[str]:
        """Place what the programme of the room asks for; return what it must have but cannot."""
        missing = []
        for number, item in enumerate(PROGRAMMES.get(self.plot.room.label, ())):
            rng = np.random.default_rng((*self.seed, number))
            if rng.random() > item.chance:
                continue
            for copy in range(self._count(item, rng)):
                is_needed = copy == 0 and item.chance >= 1
                if not is_needed and 1 - self.plot.free_share > FULLEST:
                    break
                if not self.place(item, rng, NEEDED_TRIES if is_needed else 2) and is_needed:
                    smaller = replace(item, model=item.instead, fit=None)
                    if not item.instead or not self.place(smaller, rng, NEEDED_TRIES):
                        missing.append(item.model)
        there = {placed.piece.model for placed in self.plot.placed}
        return [model for model in missing if model not in there]

    def _count(self, item: Item, rng: np.random.Generator) -> int:
        """Draw how many of an item a room gets: more in a large one, if it may have several."""
        count = int(rng.integers(item.least, item.most + 1))
        if item.most == 1:
            return count
        return max(item.least, round(count * max(1.0, self.plot.room.floor.area / USUAL_M2)))

    def place(self, item: Item, rng: np.random.Generator, tries: int = 2) -> bool:
        """Build an item and put it somewhere: other ones of it, or smaller ones, until one fits."""
        most = self._longest() - 0.08 if item.fit else 0.0
        for shrink in (1.0, 0.85, 0.7, 0.55) if item.fit else (1.0,) * tries:
            options = {}
            if item.fit:
                name, low, high = item.fit
                size = min(high, most) * shrink
                if size < low:
                    return False
                options[name] = round(size, 2)
            piece = make_piece(item.model, rng, self.look, **options)
            placed = self.somewhere(piece, item, rng)
            if placed is not None:
                self.plot.put(placed)
                return True
        return False

    def _longest(self) -> float:
        spans = [free_spans(wall)[:1] for wall in self.plot.walls]
        return max((b - a for span in spans for a, b in span), default=0.0)

    def somewhere(self, piece: Piece, item: Item, rng: np.random.Generator) -> Placed | None:
        """Find a place for a piece that is built."""
        if item.near is not None and (placed := self._near(piece, *item.near, rng)) is not None:
            return placed
        if item.where in ("wall", "hung", "corner"):
            return self._at_wall(piece, item.where == "corner", rng)
        if item.where == "free" and float(piece.low[1]) > -0.1 and rng.random() < 0.65:
            placed = self._at_wall(piece, False, rng)
            if placed is not None:
                return placed
        return self._free(piece, item.where == "centre", rng)

    def _at_wall(self, piece: Piece, in_corner: bool, rng: np.random.Generator) -> Placed | None:
        left, right = float(piece.low[0]), float(piece.high[0])
        # Pieces built round their middle stand off the wall by their own depth.
        behind = -float(piece.low[1])
        offset = behind if behind > 0.06 else 0.0
        lengths = np.array([wall.face.length for wall in self.plot.walls])
        for _ in range(TRIES):
            number = int(rng.choice(len(lengths), p=lengths / lengths.sum()))
            wall = self.plot.walls[number]
            spans = [(a, b) for a, b in free_spans(wall) if b - a >= right - left]
            if float(piece.low[2]) > 0.8:
                spans = [(0.1, wall.face.length - 0.1)]
            if not spans:
                continue
            a, b = spans[int(rng.integers(len(spans)))]
            ends = (a - left + 0.01, b - right - 0.01)
            if in_corner:
                ends = (0.05 - left, wall.face.length - 0.05 - right)
            share = float(rng.integers(2)) if in_corner or rng.random() < 0.55 else rng.random()
            x = ends[0] + float(share) * (ends[1] - ends[0])
            if offset:
                stand = self.plot.wall_stand(number, x).at(0, offset + 0.02)
                if self.plot.fits(piece, stand) and not self.plot.hides_window(piece, number, x):
                    return Placed(piece, stand)
            elif self.plot.fits_at_wall(piece, number, x):
                return Placed(piece, self.plot.wall_stand(number, x), number, x)
        return None

    def _free(self, piece: Piece, in_centre: bool, rng: np.random.Generator) -> Placed | None:
        floor = self.plot.room.floor
        size = np.array([floor.x1 - floor.x0, floor.y1 - floor.y0])
        for attempt in range(TRIES):
            if in_centre:
                spread = 0.02 + 0.25 * attempt / TRIES
                x, y = np.array(floor.centre) + rng.uniform(-spread, spread, 2) * size
            else:
                x, y = self.plot.free_middle(rng)
            facing = self.plot.walls[int(rng.integers(len(self.plot.walls)))].face.stand.facing
            facing += float(rng.normal(0, 0.04)) if rng.random() < 0.5 else 0.0
            middle = (piece.low + piece.high) / 2
            surfaces = self.plot.walls[0].face.stand.surfaces
            stand = Stand(surfaces, (float(x), float(y), self.plot.room.base_m), facing)
            stand = stand.at(-float(middle[0]), -float(middle[1]))
            if self.plot.fits(piece, stand, 0.06):
                return Placed(piece, stand)
        return None

    def _near(self, piece: Piece, how: str, model: str, rng: np.random.Generator) -> Placed | None:
        """Find a place beside, before or facing a piece of a model."""
        for other in [placed for placed in self.plot.placed if placed.piece.model == model]:
            for _ in range(6):
                if how == "beside" and other.wall >= 0:
                    gap = float(rng.uniform(0.02, 0.08))
                    x = other.x + float(other.piece.high[0] - piece.low[0]) + gap
                    if rng.random() < 0.5:
                        x = other.x + float(other.piece.low[0] - piece.high[0]) - gap
                    if self.plot.fits_at_wall(piece, other.wall, x):
                        return Placed(piece, self.plot.wall_stand(other.wall, x), other.wall, x)
                    continue
                aside = float(rng.uniform(-0.3, 0.3))
                far = float(other.piece.high[1] - piece.low[1])
                turn = 0.0
                if how == "facing":
                    far = float(other.piece.high[1] + piece.high[1] + rng.uniform(1.3, 2.4))
                    turn = np.pi
                else:
                    far += float(rng.uniform(0.3, 0.45))
                stand = other.stand.at(aside, far, 0, turn)
                if self.plot.fits(piece, stand):
                    return Placed(piece, stand)
        return None

    def scatter(self, rng: np.random.Generator, density: float) -> None:
        """Put small things on tables and shelves, about `density` of them on each."""
        for placed in list(self.plot.placed):
            if placed.is_hung or package_of(placed.piece.model) == "decor":
                continue
            tops = _tops(placed)
            taken = [_above(placed, tops)] if tops else []
            for _ in range(int(rng.poisson(density)) if tops else 0):
                piece = make_piece(SMALL[int(rng.integers(len(SMALL)))], rng, self.look)
                corners = tops[int(rng.integers(len(tops)))]
                u, v = rng.uniform(0.2, 0.8, 2)
                at = (1 - v) * ((1 - u) * corners[0] + u * corners[1])
                at += v * ((1 - u) * corners[3] + u * corners[2])
                around = np.concatenate(taken) - at[:2]
                if len(around) and np.linalg.norm(around, axis=1).min() < SMALL_APART_M:
                    continue
                taken.append(at[None, :2])
                facing = placed.stand.facing + float(rng.uniform(-0.6, 0.6))
                where = (float(at[0]), float(at[1]), float(at[2]) + 0.002)
                self.plot.put(Placed(piece, Stand(placed.stand.surfaces, where, facing)))


def _above(placed: Placed, tops: list[FloatArray]) -> FloatArray:
    """Return where on the floor plan (N, 2) a piece's own parts rise above its tops."""
    top = float(tops[0][0, 2]) - placed.stand.origin[2]
    corners = np.concatenate([quad.corners for quad in placed.piece.surfaces.quads])
    higher = corners[corners[:, 2] > top + 0.015]
    return np.asarray(placed.stand.world(higher * (-1, 1, 1))[:, :2])


def _tops(placed: Placed) -> list[FloatArray]:
    """Return the corners (4, 3) in the world of a piece's flat tops that things can lie on."""
    found = []
    highest = 0.0
    for quad in placed.piece.surfaces.quads:
        c = quad.corners
        if np.ptp(c[:, 2]) > 1e-6 or not TOP_M[0] < c[0, 2] < TOP_M[1]:
            continue
        up = np.cross(c[3] - c[0], c[1] - c[0])
        if (
            up[2] > TOP_AREA_M2
            and min(np.linalg.norm(c[1] - c[0]), np.linalg.norm(c[3] - c[0])) > 0.25
        ):
            highest = max(highest, float(c[0, 2]))
            found.append(c)
    return [placed.stand.world(c * (-1, 1, 1)) for c in found if c[0, 2] > highest - 0.02]
