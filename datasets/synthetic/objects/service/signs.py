"""Signs, plans and boards on corridor walls."""

from __future__ import annotations

import cv2

from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.objects.service.panels import (
    DARK,
    SIGN_GLOW,
    STEEL,
    WHITE,
    hang_panel,
)
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, office, signs
from roomgraph.datasets.synthetic.textures.patterns import Colour, pick, plain

__all__ = [
    "directory_board",
    "evacuation_plan",
    "exit_sign",
    "floor_number",
    "notice_board",
    "room_plate",
]


def notice_board(stand: Stand, look: Look, *, width: float = 1.2) -> None:
    """Hang a cork board full of notices."""
    tall = float(stand.rng.uniform(0.75, 1.0))
    face = Material(office.pinboard(stand.rng, int(300 * tall), int(300 * width)))
    rim = look.wooden(stand.rng) if stand.rng.random() < 0.5 else paint(STEEL)
    with stand.surfaces.thing("notice_board"):
        hang_panel(stand, width, (1.0, 1.0 + tall), face, rim)
        for x in (-width / 2 - 0.015, width / 2 - 0.015):
            stand.box((x, x + 0.03), (0.0, 0.04), (0.985, 1.015 + tall), rim)
        for z in (0.985, 0.985 + tall):
            stand.box((-width / 2, width / 2), (0.0, 0.04), (z, z + 0.03), rim)


def exit_sign(stand: Stand, look: Look) -> None:
    """Hang the green lit sign of an emergency exit."""
    width, rng = float(stand.rng.uniform(0.34, 0.5)), stand.rng
    face = signs.exit_sign(120, 250, bool(rng.random() < 0.5))
    z = float(rng.uniform(2.12, 2.25))
    with stand.surfaces.thing("exit_sign"):
        rim = paint(WHITE if rng.random() < 0.6 else signs.SIGN_GREEN)
        hang_panel(stand, width, (z, z + width / 2), Material(face, glow=SIGN_GLOW), rim, 0.06)


def evacuation_plan(stand: Stand, look: Look) -> None:
    """Hang the plan of the ways out, in a frame."""
    rng, across = stand.rng, bool(stand.rng.random() < 0.5)
    plan = signs.evacuation_plan(rng, 240 if across else 330, 330 if across else 240)
    rim: Colour = pick(rng, (STEEL, DARK, (240, 240, 240)))
    face = Material(ink.framed(plan, rim, 9))
    with stand.surfaces.thing("evacuation_plan"):
        width, tall = (0.62, 0.46) if across else (0.46, 0.62)
        hang_panel(stand, width, (1.3, 1.3 + tall), face, paint(rim), 0.022)


def room_plate(stand: Stand, look: Look, *, title: str = "OFFICE") -> None:
    """Hang the plate beside a room's door."""
    side = float(stand.rng.uniform(0.16, 0.22))
    face = Material(signs.room_plate(stand.rng, 140, 150, title))
    with stand.surfaces.thing("sign"):
        hang_panel(stand, 1.07 * side, (1.45, 1.45 + side), face, paint(STEEL), 0.016)


def directory_board(stand: Stand, look: Look) -> None:
    """Hang a board that tells who is on which floor."""
    rng, back = stand.rng, pick(stand.rng, ((36, 44, 60), (240, 240, 238), (70, 40, 40), STEEL))
    text: Colour = (246, 246, 240) if sum(back) < 400 else (30, 34, 44)
    image = plain(420, 300, back)
    ink.write(image, "DIRECTORY", (20, 8, 280, 58), text, thickness=2)
    for row in range(6):
        y, stripe = 70 + 57 * row, pick(rng, ink.VIVID)
        cv2.rectangle(image, (12, y), (58, y + 46), stripe, -1)
        ink.write(image, str(6 - row), (14, y + 4, 56, y + 42), (250, 250, 250), thickness=2)
        for line in (y + 2, y + 25):
            title = f"{int(rng.integers(100, 700))} {ink.word(rng)} {ink.word(rng)}"
            ink.write(image, title, (66, line, 290, line + 21), text)
    with stand.surfaces.thing("sign"):
        wide = float(rng.uniform(0.7, 1.0))
        hang_panel(stand, wide, (0.95, 0.95 + 1.3 * wide), Material(image), look.metallic())


def floor_number(stand: Stand, look: Look, *, floor: int = 1) -> None:
    """Hang a plate with the number of the floor."""
    face = Material(signs.floor_number(stand.rng, 280, 220, floor))
    wide = float(stand.rng.uniform(0.4, 0.6))
    with stand.surfaces.thing("sign"):
        hang_panel(stand, wide, (1.3, 1.3 + 1.27 * wide), face, look.metallic(), 0.02)
