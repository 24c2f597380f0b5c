"""Draw ``architecture.svg`` from the imports of the code: ``python app/docs/draw_architecture.py``.

The four floors are bands. A box is a package, as wide as it has lines of code. The files in
no package share one box at the right of their floor; a long one that imports packages of its floor
has a box of its own. Arcs are imports within a floor (those by the shared box are left out). Arrows
below a box are imports from lower floors, in their colour. Thicker means more imports.
"""

from __future__ import annotations

import ast
import sys
from collections import Counter
from collections.abc import Iterator
from graphlib import TopologicalSorter
from pathlib import Path

import matplotlib

matplotlib.use("svg")

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.patches import FancyArrowPatch, FancyBboxPatch, PathPatch
from matplotlib.path import Path as Curve

ROOT = Path(__file__).resolve().parents[2]
COLOURS = {"app": "#3d6fa5", "semantics": "#4d8f6b", "slam": "#c2783a", "datasets": "#7d659c"}
TOLD = {
    "app": "the command, and what holds a run together",
    "semantics": "what kind of place each part is, and the graph of the rooms",
    "slam": "where the camera is, and the map",
    "datasets": "what comes in: frames, cameras, trajectories",
}
LEFT_OUT = {"_root", "docs", "__pycache__"}
# Inches.
WIDTH, BAND, GAP, BOX, MARGIN = 12.6, 3.15, 0.22, 0.46, 0.25
EDGE, NAMES, ARC = 1.95, 0.5, 1.4  # down to the boxes, height of the names, height of the arcs
PER_LINE, LETTER = 0.8 / 1000, 0.1
GREY, INK = "#80858e", "#2b2f36"
LONG = 200  # lines of a file that may have a box of its own
CAPTION = "Width: lines of code. Arcs: imports within a floor. Arrows: imports from lower floors."

Box = tuple[str, str]  # floor, package or file


def files_of(floor: str) -> Iterator[tuple[str, Path]]:
    """Yield each file of a floor with its package, or its own name if it is in none."""
    for path in sorted((ROOT / floor).rglob("*.py")):
        first = path.relative_to(ROOT / floor).parts[0]
        if first not in LEFT_OUT:
            yield first, path


def imports_of(path: Path) -> Iterator[Box]:
    """Yield floor and package, or file, of what a file imports of the project."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.module and not node.level:
            names = [f"{node.module}.{alias.name}" for alias in node.names]
            names = names[:1] if node.module.count(".") > 1 else names
        elif isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        else:
            continue
        for name in names:
            parts = name.split(".")
            if parts[0] == "roomgraph" and len(parts) > 2 and parts[1] in COLOURS:
                floor, first = parts[1], parts[2]
                yield floor, first if (ROOT / floor / first).is_dir() else f"{first}.py"


def survey() -> tuple[Counter[Box], Counter[tuple[Box, Box]]]:
    """Return the lines of each box and the number of imports from each to each other."""
    found = [(floor, name, path) for floor in COLOURS for name, path in files_of(floor)]
    alone = {
        (floor, name) for floor, name, path in found
        if name.endswith(".py") and len(path.read_text(encoding="utf-8").splitlines()) >= LONG
        and any(f == floor and not to.endswith(".py") for f, to in imports_of(path))
    }  # fmt: skip

    def box(floor: str, name: str) -> Box:
        return (floor, name if not name.endswith(".py") or (floor, name) in alone else "files")

    lines: Counter[Box] = Counter()
    arrows: Counter[tuple[Box, Box]] = Counter()
    for floor, name, path in found:
        source = box(floor, name)
        lines[source] += len(path.read_text(encoding="utf-8").splitlines())
        for target in {box(*target) for target in imports_of(path)} - {source}:
            arrows[source, target] += 1
    return lines, arrows


def ordered(floor: str, lines: Counter[Box], arrows: Counter[tuple[Box, Box]]) -> list[Box]:
    """Return a floor's boxes so that every import within it runs to the right."""
    sorter: TopologicalSorter[Box] = TopologicalSorter()
    for box in sorted(lines):
        if box[0] == floor:
            sorter.add((floor, "files"), *{box} - {(floor, "files")})
    for source, target in within(floor, arrows):
        sorter.add(target, source)
    return list(sorter.static_order())


def within(floor: str, arrows: Counter[tuple[Box, Box]]) -> list[tuple[Box, Box]]:
    """Return what is drawn as arcs: from and to."""
    inside = [pair for pair in sorted(arrows) if pair[0][0] == pair[1][0] == floor]
    return [pair for pair in inside if pair[0] != (floor, "files")]


def thickness(count: int) -> float:
    """Return the width of a line for a number of imports, in points."""
    return float(0.6 + 0.55 * count**0.5)


def draw_band(axes: Axes, floor: str, top: float, height: float) -> None:
    """Draw a floor's band with its name and what it is for."""
    frame = FancyBboxPatch(
        (MARGIN, top - height), WIDTH - 2 * MARGIN, height, facecolor=COLOURS[floor], alpha=0.1,
        boxstyle="round,pad=0,rounding_size=0.12", edgecolor="none",
    )  # fmt: skip
    axes.add_patch(frame)
    axes.text(MARGIN + 0.2, top - 0.4, floor, fontsize=19, weight="bold", color=COLOURS[floor])
    axes.text(MARGIN + 1.95, top - 0.4, TOLD[floor], fontsize=11.5, color=INK)


def draw_boxes(
    axes: Axes, boxes: list[Box], lines: Counter[Box], edge: float
) -> dict[Box, tuple[float, float]]:
    """Draw a floor's boxes in a row; return the middle of each one's upper edge."""
    slots = [max(lines[box] * PER_LINE, LETTER * len(box[1])) for box in boxes]
    beside = min(0.9, (WIDTH - 2 * MARGIN - 0.5 - sum(slots)) / (len(slots) - 1))
    left, middles = (WIDTH - sum(slots) - beside * (len(slots) - 1)) / 2, {}
    for box, slot in zip(boxes, slots, strict=True):
        x, width = left + slot / 2, lines[box] * PER_LINE
        patch = FancyBboxPatch(
            (x - width / 2, edge - BOX), width, BOX, facecolor=COLOURS[box[0]], edgecolor="none",
            boxstyle="round,pad=0,rounding_size=0.06", alpha=0.6 if box[1] == "files" else 1,
        )  # fmt: skip
        axes.add_patch(patch)
        axes.text(x, edge - BOX - 0.21, box[1], fontsize=11, ha="center", color=INK)
        axes.text(x, edge - BOX - 0.4, f"{lines[box]}", fontsize=8.5, ha="center", color=GREY)
        middles[box] = (x, edge)
        left += slot + beside
    return middles


def draw_arc(axes: Axes, start: tuple[float, float], end: tuple[float, float], count: int) -> None:
    """Draw imports within a floor: an arc over the boxes between, with an arrow's head."""
    (x0, y), (x1, _) = start, end
    height = 4 / 3 * ARC * ((x1 - x0) / WIDTH) ** 0.6
    curve = Curve([(x0, y), (x0, y + height), (x1, y + height), (x1, y + 0.03)], [1, 4, 4, 4])
    arc = PathPatch(curve, fill=False, edgecolor=INK, alpha=0.3, linewidth=thickness(count))
    axes.add_patch(arc)
    axes.plot([x1], [y + 0.04], marker="v", markersize=5, color=INK, markeredgewidth=0)


def draw_feet(
    axes: Axes, box: Box, middle: tuple[float, float], arrows: Counter[tuple[Box, Box]]
) -> None:
    """Draw an arrow down from a box for each lower floor that it imports."""
    lower: Counter[str] = Counter()
    for (source, target), count in arrows.items():
        if source == box and target[0] != box[0]:
            lower[target[0]] += count
    floors = [floor for floor in COLOURS if floor in lower]
    start, end = middle[1] - BOX - NAMES, middle[1] + EDGE - BAND - GAP
    for place, floor in enumerate(floors):
        x = middle[0] + 0.18 * (place - (len(floors) - 1) / 2)
        arrow = FancyArrowPatch(
            (x, start), (x, end), arrowstyle="-|>", mutation_scale=9, shrinkA=0, shrinkB=0,
            linewidth=thickness(lower[floor]), color=COLOURS[floor],
        )  # fmt: skip
        axes.add_patch(arrow)


def draw(path: Path) -> None:
    """Draw the house to a file, in the format of its ending."""
    plt.rcParams.update({"font.family": "DejaVu Sans", "svg.hashsalt": "roomgraph"})
    lines, arrows = survey()
    height = len(COLOURS) * (BAND + GAP) + MARGIN
    figure = plt.figure(figsize=(WIDTH, height))
    axes = figure.add_axes((0, 0, 1, 1), xlim=(0, WIDTH), ylim=(0, height))
    axes.axis("off")
    axes.text(WIDTH / 2, MARGIN - 0.08, CAPTION, fontsize=10, ha="center", color=GREY)
    for number, floor in enumerate(COLOURS):
        top = height - MARGIN - number * (BAND + GAP)
        is_lowest = number + 1 == len(COLOURS)
        draw_band(axes, floor, top, EDGE + BOX + NAMES + 0.06 if is_lowest else BAND)
        middles = draw_boxes(axes, ordered(floor, lines, arrows), lines, top - EDGE)
        for source, target in within(floor, arrows):
            draw_arc(axes, middles[source], middles[target], arrows[source, target])
        for box, middle in middles.items():
            draw_feet(axes, box, middle, arrows)
    figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None, dpi=110)


if __name__ == "__main__":
    draw(Path(sys.argv[1]) if sys.argv[1:] else Path(__file__).with_name("architecture.svg"))
