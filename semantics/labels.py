"""The label space: the kinds of place, with an id and a colour each."""

from __future__ import annotations

import colorsys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from roomgraph.semantics.documents import read_document, write_document
from roomgraph.semantics.errors import SemanticsError

UNKNOWN = "unknown"
SCHEMA, VERSION = "roomgraph/labels", 1

Colour = tuple[int, int, int]

# Chosen to be told apart on white, on black and on top of a point cloud; one family of hues for
# each use of a room (work: blues, water: teals, food: warm, rest: purples and pinks, ways: light).
ROOM_COLOURS: dict[str, Colour] = {
    UNKNOWN: (128, 128, 128),
    "corridor": (237, 201, 72),
    "hallway": (156, 117, 95),
    "stairs": (186, 176, 172),
    "elevator_area": (225, 87, 89),
    "elevator": (225, 87, 89),
    "lobby": (210, 180, 120),
    "office": (78, 121, 167),
    "laboratory": (89, 161, 79),
    "meeting_room": (45, 85, 185),
    "conference_room": (45, 85, 185),
    "classroom": (120, 160, 230),
    "printer_area": (95, 105, 125),
    "library": (140, 80, 30),
    "bathroom": (60, 190, 200),
    "kitchen": (242, 142, 43),
    "dining_room": (200, 60, 140),
    "living_room": (140, 209, 125),
    "bedroom": (176, 122, 201),
    "storage": (130, 130, 60),
    "store": (255, 157, 167),
}
_ALIASES = {"livingroom": "living_room", "diningroom": "dining_room", "lab": "laboratory"}


@dataclass(frozen=True, slots=True)
class LabelSpace:
    """Names and colours of the kinds of place; a label's id is its position.

    Attributes
    ----------
    names : tuple of str
        The first is ``unknown``: id 0.
    colours : tuple of (red, green, blue)
        0 to 255 each, one a name.
    """

    names: tuple[str, ...] = (UNKNOWN,)
    colours: tuple[Colour, ...] = (ROOM_COLOURS[UNKNOWN],)

    def __post_init__(self) -> None:
        if not self.names or self.names[0] != UNKNOWN or len(set(self.names)) != len(self.names):
            raise SemanticsError(
                "not a label space", expected=f"different names, the first {UNKNOWN!r}",
                got=", ".join(self.names),
            )  # fmt: skip
        if len(self.colours) != len(self.names):
            raise SemanticsError(
                "not a label space",
                expected=f"{len(self.names)} colours",
                got=str(len(self.colours)),
            )

    @classmethod
    def of(cls, names: Iterable[str]) -> LabelSpace:
        """Return the label space of `names`, sorted, with `unknown` before them."""
        rooms = sorted(set(names) - {UNKNOWN})
        colours = [ROOM_COLOURS[UNKNOWN]]
        for name in rooms:
            fixed = ROOM_COLOURS.get(_ALIASES.get(_plain(name), _plain(name)))
            colours.append(fixed if fixed and fixed not in colours else _new_colour(colours))
        return cls((UNKNOWN, *rooms), tuple(colours))

    def __len__(self) -> int:
        return len(self.names)

    def id_of(self, name: str) -> int:
        """Return the id of `name`.

        Raises
        ------
        SemanticsError
            There is no such label.
        """
        if name not in self.names:
            raise SemanticsError("no such label", expected=", ".join(self.names), got=repr(name))
        return self.names.index(name)

    def with_label(self, name: str) -> LabelSpace:
        """Return the label space with one more label at its end, or itself if it has that one.

        The others keep their ids and colours.
        """
        if name in self.names:
            return self
        (colour,) = LabelSpace.of([name]).colours[1:]
        taken = list(self.colours)
        return LabelSpace(
            (*self.names, name), (*taken, colour if colour not in taken else _new_colour(taken))
        )

    @property
    def palette(self) -> NDArray[np.uint8]:
        """The colours as an array (n_labels, 3), row = id."""
        return np.array(self.colours, dtype=np.uint8)


def write_labels(path: Path, labels: LabelSpace) -> None:
    """Write a label space as JSON: a list of id, name, colour."""
    rows = [
        {"id": i, "name": name, "colour": list(colour)}
        for i, (name, colour) in enumerate(zip(labels.names, labels.colours, strict=True))
    ]
    write_document(path, SCHEMA, VERSION, {"labels": rows})


def read_labels(path: Path) -> LabelSpace:
    """Read what `write_labels` wrote.

    Raises
    ------
    SemanticsError
        The file is missing or is not a label space.
    """
    document = read_document(path, SCHEMA, VERSION)
    try:
        rows = sorted(document["labels"], key=lambda row: int(row["id"]))
        if [int(row["id"]) for row in rows] != list(range(len(rows))):
            raise ValueError("ids are not 0, 1, 2 ...")
        colours = tuple((int(r), int(g), int(b)) for r, g, b in (row["colour"] for row in rows))
        return LabelSpace(tuple(str(row["name"]) for row in rows), colours)
    except (KeyError, TypeError, ValueError) as error:
        raise SemanticsError(
            "invalid label space", where=path,
            expected='"labels": a list of id, name, colour', got=f"{type(error).__name__} {error}",
        ) from error  # fmt: skip


def _plain(name: str) -> str:
    return name.strip().lower().replace(" ", "_").replace("-", "_")


def _new_colour(taken: list[Colour]) -> Colour:
    """Return the colour of a fixed set of candidates that is farthest from those taken."""
    candidates = [
        tuple(round(255 * c) for c in colorsys.hsv_to_rgb(hue / 24, saturation, value))
        for saturation, value in ((0.65, 0.9), (0.85, 0.6), (0.35, 0.95))
        for hue in range(24)
    ]
    distances = np.linalg.norm(np.array(candidates)[:, None] - np.array(taken)[None], axis=2)
    red, green, blue = candidates[int(distances.min(axis=1).argmax())]
    return red, green, blue
