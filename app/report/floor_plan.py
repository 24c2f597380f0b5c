"""The floor plan as a drawing: rooms, walls, doorways, the path walked and the graph's nodes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.path import Path as Outline
from numpy.typing import NDArray

from roomgraph.datasets import se3
from roomgraph.datasets.files import replacing
from roomgraph.semantics.graph.graph import Doorway, RoomPolygon, SemanticGraph
from roomgraph.semantics.rooms.doorway_lines import doorway_ends
from roomgraph.slam.reconstruction.occupancy_grid import FREE, OCCUPIED, OccupancyGrid

FloatArray = NDArray[np.float64]
# For a page as wide as a phone: a figure of this width with this type is legible on one.
WIDTH_INCHES = 5.0
_LARGE, _SMALL = 9.0, 5.0
# Width of a bold letter, with and without some room on both sides of a name, and height of one and
# two lines; in heights of a letter.
_EM, _TIGHT, _ONE_LINE, _TWO_LINES = 0.8, 0.7, 1.5, 2.8
# Names on one line, where two are not clear of the way, are smaller.
_SMALLER = 0.8
# Names are tried at least so far apart, need to be no further than this from the way, and are tried
# maximum number of spots tried across a room.
_SPOT_M, _CLEAR_M, _MOST_SPOTS = 0.1, 0.15, 20
_WALL, _FURNITURE = (60, 64, 72, 255), (120, 126, 136, 130)
_SEEN = (243, 243, 240, 255)
# What is occupied this near to a room's outline is its wall, further in it is furniture.
_WALL_REACH_M = 0.12
_INK, _DOOR = "#22262e", "#8a4b2a"


def draw_floor_plan(graph: SemanticGraph, grid: OccupancyGrid, path_world: FloatArray) -> Figure:
    """Draw the floor from above, in the map frame.

    Parameters
    ----------
    graph : SemanticGraph
        With the places' rooms, where known.
    grid : OccupancyGrid
        Walls and furniture.
    path_world : (N, 3) float64
        Camera centres in the order of time, metres.
    """
    window = _window(graph, grid)
    size = window[:, 1] - window[:, 0]
    height = float(np.clip(WIDTH_INCHES * size[1] / size[0], 1.6, 7.5))
    figure = Figure(figsize=(WIDTH_INCHES, height + 0.35), facecolor="white")
    axes = figure.add_axes((0.01, 0.01, 0.98, 0.98))
    axes.set(xlim=window[0], ylim=(window[1, 0] - 0.09 * size[0], window[1, 1]), aspect="equal")
    axes.axis("off")
    _draw_rooms(axes, graph)
    _draw_cells(axes, graph, grid)
    for door in graph.doorways:
        _draw_doorway(axes, graph, door)
    path = se3.transform(grid.T_map_world, path_world)
    axes.plot(path[:, 0], path[:, 1], color=_INK, lw=0.7, alpha=0.55, zorder=4)
    if len(path):
        axes.plot(*path[-1, :2], marker="s", ms=5, mfc=_INK, mec="white", mew=0.8, zorder=6)
        axes.plot(*path[0, :2], marker="o", ms=6, mfc="white", mec=_INK, mew=1.2, zorder=7)
    nodes = se3.transform(grid.T_map_world, graph.positions)
    colours = [_colour(graph, node.label_id) for node in graph.nodes]
    axes.scatter(nodes[:, 0], nodes[:, 1], s=13, c=colours or None, ec="white", lw=0.6, zorder=5)
    _name_rooms(axes, graph, path[:, :2], WIDTH_INCHES * 72 / float(size[0]))
    _draw_scale(axes, window, float(size[0]))
    return figure


def save_floor_plan(figure: Figure, png: Path, svg: Path) -> None:
    """Write a floor plan as PNG and SVG; the same plan gives the same bytes."""
    with replacing(png) as temporary:
        figure.savefig(temporary, dpi=220)
    with (
        rc_context({"svg.hashsalt": "roomgraph", "svg.fonttype": "none"}),
        replacing(svg) as temporary,
    ):
        figure.savefig(temporary, metadata={"Date": None})


def _window(graph: SemanticGraph, grid: OccupancyGrid) -> FloatArray:
    """Return minimum and maximum x, minimum and maximum y (2, 2) of everything drawn."""
    if graph.rooms:
        points = np.concatenate([room.polygon_map for room in graph.rooms])
    else:
        rows, columns = np.nonzero(grid.cells >= FREE)
        points = np.column_stack([columns, rows]) * grid.cell_m + grid.origin_xy
    if not len(points):
        points = np.zeros((1, 2))
    return np.column_stack([points.min(axis=0) - 0.4, points.max(axis=0) + 0.4])


def _draw_rooms(axes: Axes, graph: SemanticGraph) -> None:
    for room in graph.rooms:
        colour = _colour(graph, room.label_id)
        axes.fill(*room.polygon_map.T, fc=(*colour, 0.30), ec=(*colour, 0.9), lw=1.0, zorder=1)


def _draw_cells(axes: Axes, graph: SemanticGraph, grid: OccupancyGrid) -> None:
    """Paint walls dark, furniture lighter, and free space outside rooms very light."""
    occupied = grid.cells == OCCUPIED
    image = np.zeros((*grid.cells.shape, 4), dtype=np.uint8)
    if not graph.rooms:
        image[grid.cells == FREE] = _SEEN
    image[occupied] = _WALL
    rows, columns = np.nonzero(occupied)
    centres = (np.column_stack([columns, rows]) + 0.5) * grid.cell_m + grid.origin_xy
    for room in graph.rooms:
        outline = Outline(np.vstack([room.polygon_map, room.polygon_map[:1]]))
        inside = outline.contains_points(centres, radius=-_WALL_REACH_M)
        image[rows[inside], columns[inside]] = _FURNITURE
    low = grid.origin_xy
    high = low + np.array(grid.cells.shape[::-1]) * grid.cell_m
    limits = axes.axis()
    axes.imshow(
        image, extent=(low[0], high[0], low[1], high[1]), origin="lower",
        interpolation="nearest", zorder=2,
    )  # fmt: skip
    axes.axis(limits)


def _draw_doorway(axes: Axes, graph: SemanticGraph, door: Doorway) -> None:
    """Draw a white gap with a sill along the wall that the doorway is in."""
    ends = doorway_ends(graph, door)
    axes.plot(*ends.T, color="white", lw=4.0, solid_capstyle="butt", zorder=3)
    axes.plot(*ends.T, color=_DOOR, lw=1.6, solid_capstyle="butt", zorder=3)


def _name_rooms(
    axes: Axes, graph: SemanticGraph, path_map: FloatArray, points_per_metre: float
) -> None:
    """Write the name and area into each place, as large as fits, off the path if possible."""
    background = {"boxstyle": "round,pad=0.12", "fc": "white", "ec": "none", "alpha": 0.45}
    for room in graph.rooms:
        name = room.name.replace("_", " ")
        area = f"{room.area_m2:.1f} m²"
        width = float(np.ptp(room.polygon_map[:, 0])) * points_per_metre
        size = float(np.clip(width / (_EM * max(len(name), 6)), _SMALL, _LARGE))
        tries = []
        for text, lines, scale in (
            (f"{name}\n{area}", _TWO_LINES, 1.0), (f"{name}  {area}", _ONE_LINE, _SMALLER),
        ):  # fmt: skip
            letters = _TIGHT * max(len(line) for line in text.split("\n"))
            box = scale * size / points_per_metre * np.array([letters, lines])
            tries.append((text, scale * size, *_clear_spot(room, path_map, box / 2)))
        text, size, (x, y), _ = max(tries, key=lambda tried: tried[-1])
        axes.text(
            x, y, text, ha="center", va="center", fontsize=size,
            color=_INK, fontweight="bold", linespacing=1.25, bbox=background, zorder=5.5,
        )  # fmt: skip


def _clear_spot(
    room: RoomPolygon, path_map: FloatArray, half: FloatArray
) -> tuple[FloatArray, float]:
    """Return the spot in a place that is farthest from a path (N, 2), and its distance, metres.

    It is twice `half` (2,) wide and high, metres, and near the place's middle; in the middle, with
    a clearance below 0, if it fits nowhere.
    """
    low, high = room.polygon_map.min(axis=0) + half, room.polygon_map.max(axis=0) - half
    if (high <= low).any():
        return room.centre_map, -1.0
    counts = np.clip((high - low) / _SPOT_M, 2, _MOST_SPOTS).astype(int)
    x, y = (np.linspace(*span) for span in zip(low, high, counts, strict=True))
    spots = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    corners = spots[:, None] + half * np.array([(-1, -1), (-1, 1), (1, -1), (1, 1)])
    outline = Outline(np.vstack([room.polygon_map, room.polygon_map[:1]]))
    fits = outline.contains_points(corners.reshape(-1, 2)).reshape(-1, 4).all(axis=1)
    if not fits.any():
        return room.centre_map, -1.0
    spots = spots[fits]
    # Of a long way one spot each is enough, or it would take as much memory as it is long.
    way = np.unique(np.rint(path_map / _SPOT_M), axis=0) * _SPOT_M
    way = way[np.all((way > low - 2 * half) & (way < high + 2 * half), axis=1)]
    gaps = np.maximum(np.abs(spots[:, None] - way) - half, 0).max(axis=2)
    clear = np.minimum(gaps.min(axis=1, initial=_CLEAR_M), _CLEAR_M)
    off = np.linalg.norm(spots - room.centre_map, axis=1)
    best = np.lexsort((off, -clear))[0]
    return spots[best], float(clear[best])


def _draw_scale(axes: Axes, window: FloatArray, width_m: float) -> None:
    """Draw a bar of one, two or five times a power of ten metres, about a fifth of the width."""
    power = 10.0 ** np.floor(np.log10(width_m / 5))
    length = max(step * power for step in (1, 2, 5) if step * power <= width_m / 5)
    x, y = window[0, 0] + 0.02 * width_m, window[1, 0] - 0.045 * width_m
    axes.plot([x, x + length], [y, y], color=_INK, lw=2.5, solid_capstyle="butt")
    axes.text(x + length + 0.012 * width_m, y, f"{length:g} m", va="center", fontsize=9, color=_INK)
    marks: list[tuple[str, dict[str, Any]]] = [
        ("start", {"marker": "o", "mfc": "white", "mec": _INK}),
        ("end", {"marker": "s", "mfc": _INK, "mec": "white"}),
        ("path", {"ls": "-", "lw": 0.8}),
        ("node", {"marker": "o", "ms": 3.0}),
        ("doorway", {"ls": "-", "lw": 1.8, "color": _DOOR}),
        ("wall", {"marker": "s", "color": np.array(_WALL) / 255, "ms": 4.5}),
        ("furniture", {"marker": "s", "color": np.array(_FURNITURE) / 255, "ms": 4.5}),
    ]
    plain: dict[str, Any] = {"color": _INK, "ls": "", "ms": 5.0}
    handles = [Line2D([], [], label=word, **(plain | style)) for word, style in marks]
    axes.legend(
        handles=handles, loc="center right", ncols=len(handles), frameon=False, fontsize=6.0,
        bbox_to_anchor=(window[0, 1], y), bbox_transform=axes.transData, borderaxespad=0.0,
        handlelength=1.2, handletextpad=0.3, columnspacing=0.9, labelcolor=_INK,
    )  # fmt: skip


def _colour(graph: SemanticGraph, label_id: int) -> tuple[float, float, float]:
    red, green, blue = (value / 255 for value in graph.labels.colours[label_id])
    return red, green, blue
