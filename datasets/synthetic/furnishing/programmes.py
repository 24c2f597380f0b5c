"""What belongs into each kind of room: a table to be read and changed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Where = Literal["wall", "corner", "free", "centre", "hung"]


@dataclass(frozen=True, slots=True)
class Item:
    """Something that a room may have.

    Attributes
    ----------
    model : str
        What it is, as the catalogue calls it.
    where : {"wall", "corner", "free", "centre", "hung"}
        At a wall, in a corner, anywhere, in the middle, on a wall.
    least, most : int
        How many, drawn evenly; more of them only where there is room.
    chance : float
        How likely the room has any.
    fit : (str, float, float) or None
        An option of the model that is fitted to the longest free wall: its name and its bounds.
    near : (str, str) or None
        Where it goes if it can: "beside", "before" or "facing" a model that is there already.
    instead : str
        A smaller model for where this one does not fit.
    """

    model: str
    where: Where
    least: int = 1
    most: int = 1
    chance: float = 1.0
    fit: tuple[str, float, float] | None = None
    near: tuple[str, str] | None = None
    instead: str = ""


PICTURES = (
    Item("picture", "hung", 1, 3, 0.7),
    Item("clock", "hung", chance=0.3),
)
OFFICE_WALLS = (
    Item("whiteboard", "hung", chance=0.5),
    Item("pinboard", "hung", chance=0.5),
    Item("poster", "hung", 1, 2, 0.6),
    Item("clock", "hung", chance=0.3),
)

PROGRAMMES: dict[str, tuple[Item, ...]] = {
    "office": (
        Item("desk", "wall", 1, 3),
        Item("desk_pair", "free", 1, 2, 0.35),
        Item("office_shelf", "wall", 1, 3, 0.9),
        Item("filing_cabinet", "wall", 1, 2, 0.7),
        Item("printer_table", "wall", chance=0.3),
        Item("waste_bin", "free", chance=0.7),
        Item("coat_stand", "corner", chance=0.4),
        Item("plant", "corner", 1, 2, 0.55),
        Item("partition_screen", "free", chance=0.15),
        Item("visitor_chair", "wall", 1, 2, 0.35),
        *OFFICE_WALLS,
    ),
    "laboratory": (
        Item("lab_bench", "wall", 1, 3, fit=("width", 1.6, 4.0)),
        Item("lab_island", "free", chance=0.6),
        Item("fume_hood", "wall", chance=0.6),
        Item("instrument_rack", "wall", 1, 2, 0.6),
        Item("gas_cylinders", "wall", chance=0.5),
        Item("lab_sink", "wall", chance=0.6),
        Item("lab_stool", "free", 1, 3, 0.8, near=("before", "lab_bench")),
        Item("storage_rack", "wall", chance=0.3),
        Item("fire_extinguisher", "hung", chance=0.5),
        Item("poster", "hung", 1, 2, 0.6),
        Item("whiteboard", "hung", chance=0.3),
        Item("waste_bin", "free", chance=0.4),
    ),
    "kitchen": (
        Item("kitchen_run", "wall", 1, 2, fit=("width", 1.8, 4.2)),
        Item("refrigerator", "wall", 1, 1, 0.95, near=("beside", "kitchen_run")),
        Item("dining_table", "free", chance=0.4),
        Item("round_table", "free", chance=0.45),
        Item("kitchen_island", "free", chance=0.25),
        Item("dishwasher", "wall", chance=0.3),
        Item("waste_bin", "free", chance=0.5),
        Item("wall_shelf", "hung", chance=0.4),
        Item("plant", "corner", chance=0.3),
        *PICTURES,
    ),
    "bathroom": (
        Item("toilet", "wall", 1, 1, 0.85),
        Item("washbasin", "wall", 1, 2),
        Item("bathtub", "wall", chance=0.5),
        Item("shower", "corner", chance=0.5),
        Item("toilet_stall", "wall", 1, 1, 0.3),
        Item("double_basin", "wall", chance=0.25),
        Item("washing_machine", "wall", chance=0.35),
        Item("laundry_basket", "free", chance=0.4),
        Item("towel_rail", "hung", 1, 2, 0.7),
        Item("bathroom_shelf", "hung", chance=0.5),
        Item("urinal", "hung", 1, 2, 0.2),
        Item("hand_dryer", "hung", chance=0.3),
        Item("paper_dispenser", "hung", chance=0.4),
    ),
    "bedroom": (
        Item("bed", "wall"),
        Item("nightstand", "wall", 1, 2, 0.85, near=("beside", "bed")),
        Item("wardrobe", "wall", 1, 2, instead="dresser"),
        Item("dresser", "wall", chance=0.55),
        Item("desk", "wall", chance=0.25),
        Item("armchair", "free", chance=0.25),
        Item("standing_mirror", "wall", chance=0.3),
        Item("bookcase", "wall", chance=0.3),
        Item("rug", "centre", chance=0.5),
        Item("teddy", "free", chance=0.15),
        Item("plant", "corner", chance=0.3),
        *PICTURES,
    ),
    "living_room": (
        Item("tv_stand", "wall"),
        Item("sofa", "free", 1, 2, near=("facing", "tv_stand")),
        Item("coffee_table", "free", chance=0.8, near=("before", "sofa")),
        Item("armchair", "free", 1, 2, 0.7),
        Item("bookcase", "wall", 1, 2, 0.7),
        Item("sideboard", "wall", chance=0.45),
        Item("fireplace", "wall", chance=0.2),
        Item("piano", "wall", chance=0.2),
        Item("floor_lamp", "corner", chance=0.6),
        Item("rug", "centre", chance=0.65),
        Item("plant", "corner", 1, 2, 0.65),
        Item("aquarium", "wall", chance=0.1),
        *PICTURES,
    ),
    "dining_room": (
        Item("dining_table", "centre", instead="round_table"),
        Item("sideboard", "wall", 1, 1, 0.85),
        Item("bookcase", "wall", chance=0.25),
        Item("rug", "centre", chance=0.3),
        Item("plant", "corner", chance=0.5),
        Item("floor_lamp", "corner", chance=0.25),
        Item("dining_chair", "free", 1, 2, 0.3),
        *PICTURES,
    ),
    "meeting_room": (
        Item("meeting_table", "centre", fit=("length", 1.4, 3.6), instead="round_table"),
        Item("projector_screen", "hung", chance=0.6),
        Item("whiteboard", "hung", chance=0.7),
        Item("tv_stand", "wall", chance=0.25),
        Item("flip_chart", "free", chance=0.55),
        Item("sideboard", "wall", chance=0.4),
        Item("coat_stand", "corner", chance=0.35),
        Item("plant", "corner", 1, 2, 0.5),
        Item("visitor_chair", "wall", 1, 3, 0.4),
        Item("water_dispenser", "wall", chance=0.2),
        *PICTURES,
    ),
    "store_room": (
        Item("storage_rack", "wall", 2, 5, fit=("width", 0.9, 1.8)),
        Item("cardboard_boxes", "free", 1, 3),
        Item("ladder", "wall", chance=0.6),
        Item("mop_bucket", "free", chance=0.5),
        Item("vacuum_cleaner", "free", chance=0.35),
        Item("cleaning_cart", "free", chance=0.3),
        Item("pallet", "free", chance=0.35),
        Item("crates", "free", chance=0.5),
        Item("work_bench", "wall", chance=0.35),
        Item("bicycle", "wall", chance=0.25),
        Item("suitcase", "free", 1, 2, 0.3),
        Item("broom", "wall", chance=0.5),
        Item("washing_machine", "wall", chance=0.15),
    ),
    "printer_area": (
        Item("printer", "wall", 1, 2),
        Item("printer_table", "wall", 1, 2, 0.8),
        Item("office_shelf", "wall", 1, 2, 0.7),
        Item("paper_shredder", "wall", chance=0.7),
        Item("filing_cabinet", "wall", 1, 3, 0.6),
        Item("water_dispenser", "wall", chance=0.35),
        Item("letter_boxes", "hung", chance=0.4),
        Item("waste_bin", "free", chance=0.7),
        Item("side_table", "free", chance=0.3),
        Item("plant", "corner", chance=0.4),
        *OFFICE_WALLS,
    ),
    "hall": (
        Item("coat_rack", "hung", 1, 2, 0.8),
        Item("shoe_rack", "wall", chance=0.75),
        Item("sideboard", "wall", chance=0.3),
        Item("standing_mirror", "wall", chance=0.4),
        Item("umbrella_stand", "corner", chance=0.5),
        Item("bench", "wall", chance=0.4),
        Item("radiator", "wall", chance=0.5),
        Item("bicycle", "wall", chance=0.15),
        Item("plant", "corner", chance=0.5),
        *PICTURES,
    ),
    "stairwell": (
        Item("floor_number", "hung"),
        Item("fire_extinguisher", "hung", chance=0.6),
        Item("evacuation_plan", "hung", chance=0.4),
    ),
    "elevator_area": (
        Item("directory_board", "hung"),
        Item("floor_number", "hung"),
        Item("bench", "wall", chance=0.6),
        Item("plant", "corner", 1, 2, 0.8),
    ),
    "corridor": (
        Item("fire_extinguisher", "hung", 1, 2, 0.85),
        Item("notice_board", "hung", 1, 2, 0.7),
        Item("radiator", "wall", 1, 2, 0.6),
        Item("exit_sign", "hung", 1, 2, 0.8),
        Item("evacuation_plan", "hung", chance=0.6),
        Item("bench", "wall", chance=0.3),
        Item("locker_row", "wall", chance=0.2),
        Item("vending_machine", "wall", chance=0.15),
        Item("plant", "corner", chance=0.3),
        Item("picture", "hung", 1, 3, 0.5),
        Item("directory_board", "hung", chance=0.3),
    ),
}

# How likely a piece has been moved, and taken away, from one visit to the next.
FIXED = {
    "kitchen_run", "toilet", "washbasin", "double_basin", "bathtub", "shower", "toilet_stall",
    "urinal", "hand_dryer", "radiator", "exit_sign", "fire_extinguisher", "floor_number",
    "evacuation_plan", "fireplace", "fume_hood", "lab_sink", "lab_bench", "letter_boxes",
}  # fmt: skip
HEAVY = {
    "desk", "desk_pair", "bed", "wardrobe", "bookcase", "office_shelf", "sofa", "piano",
    "refrigerator", "lab_island", "storage_rack", "meeting_table", "tv_stand", "kitchen_island",
    "work_bench",
}  # fmt: skip
CHANGES = {"fixed": (0.0, 0.0), "heavy": (0.15, 0.04), "loose": (0.4, 0.15)}
# What hangs there is changed for another of its kind.
REPLACED = {"picture", "poster", "pinboard", "notice_board", "whiteboard"}
# What is left standing about: on the floor, and on tables.
LEFT = (
    "cardboard_boxes", "suitcase", "plant", "dining_chair", "office_chair", "backpack",
    "side_table", "vacuum_cleaner", "coat_stand", "waste_bin",
)  # fmt: skip
SMALL = (
    "cup", "bottle", "laptop", "book_stack", "backpack", "vase", "bowl", "small_plant",
    "photo_frame", "cup",
)  # fmt: skip
