"""A page of pictures of a building: its levels from above, every room by day and by night."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.synthetic.motion.free_space import free_space
from roomgraph.datasets.synthetic.motion.walk import camera_poses
from roomgraph.datasets.synthetic.plans.layout import Room
from roomgraph.datasets.synthetic.renderer import Renderer, Sight
from roomgraph.datasets.synthetic.rendering.eye import Eye, pinhole
from roomgraph.datasets.synthetic.rendering.mesh import Image, Thing
from roomgraph.datasets.synthetic.rendering.raycast import Hits
from roomgraph.datasets.synthetic.settings import Light
from roomgraph.datasets.synthetic.structure.elevator import DOORS_S
from roomgraph.datasets.synthetic.structure.stairs import way_up
from roomgraph.datasets.synthetic.world import World

FloatArray = NDArray[np.float64]
VIEW_PX, VIEW_FOCAL = (360, 270), 0.62
EYE_M, LOOK_DOWN_DEG = 1.5, 12.0
CANDIDATES = 8
# What is looked at to choose a view is this much smaller.
SMALLER = 4
# The levels are cut at this height, and drawn at so many pixels a metre.
CUT_M, PLAN_PX_PER_M = 2.1, 42
# A thing counts for at most so much: the root of its pixels, one in sixteen being looked at.
MOST_OF_ONE = 16.0
MARGIN_PX, TITLE_PX, COLUMNS = 10, 22, 3
# One also looks a little to the left and to the right of the room's middle.
ASIDE = tuple(
    np.array([(np.cos(a), -np.sin(a)), (np.sin(a), np.cos(a))])
    for a in np.deg2rad((-50, -25, 25, 50))
)
LIGHTS: tuple[Light, Light] = ("day", "night")


@dataclass(frozen=True, slots=True, eq=False)
class RoomView:
    """A room seen from inside, by day and by night."""

    room: Room
    pictures: tuple[Image, Image]


def make_renderer(world: World) -> Renderer:
    """Return a renderer for views of a world's rooms."""
    width, height = VIEW_PX
    focal = VIEW_FOCAL * width
    camera = Intrinsics(width, height, focal, focal, (width - 1) / 2, (height - 1) / 2)
    moving = world.animation
    return Renderer(world.building, camera, moving.bodies, (), moving.lamps)


def room_views(world: World, renderer: Renderer) -> Iterator[RoomView]:
    """Look into every room from the place that shows most of it."""
    seen: set[str] = set()
    for room in world.building.rooms:
        # A room of several parts is shown once, a stairwell on its lowest level.
        if room.name in seen:
            continue
        seen.add(room.name)
        stamp_s, T = _viewpoint(world, renderer, room)
        sight = renderer.look(renderer.eye, T, stamp_s)
        colours, _ = renderer.colours(renderer.eye, sight, LIGHTS, 0.5, (world.settings.seed,))
        yield RoomView(room, (colours[LIGHTS[0]], colours[LIGHTS[1]]))


def _viewpoint(world: World, renderer: Renderer, room: Room) -> tuple[float, FloatArray]:
    """Return a time and T_world_camera from where a room is seen well."""
    if room.label == "elevator":
        return _before_elevator(world)
    if room.label == "stairwell":
        way = way_up(room.floor, world.building.plan.storey_m, 0)
        begin = np.array([room.floor.centre[0], room.floor.y0 + 0.25])
        return 0.0, _pose(begin, way[2, :2] + (way[4, :2] - way[2, :2]) / 2, room, tilt_deg=8)
    space = free_space(world.building, room.level)
    cells = np.flatnonzero(space.clearance.ravel() > 0.24)
    places = space.middles(cells)
    places = places[room.floor.distance(places) == 0]
    if not len(places):
        places = np.array([room.floor.centre])
    middle = np.array(room.floor.centre)
    distance, chosen = np.linalg.norm(places - middle, axis=1), []
    for _ in range(CANDIDATES):
        chosen.append(places[int(np.argmax(distance))])
        distance = np.minimum(distance, np.linalg.norm(places - chosen[-1], axis=1))
    poses = [
        _pose(place, target, room)
        for place in chosen
        for target in (middle, *(place + (middle - place) @ turn.T for turn in ASIDE))
    ]
    inside = [thing for thing in world.building.things if _is_in(thing, world, room)]
    eye = pinhole(renderer.intrinsics.resized(VIEW_PX[0] // SMALLER, VIEW_PX[1] // SMALLER))
    shown = [_shown(renderer, eye, inside, room, T) for T in poses]
    return 0.0, poses[int(np.argmax(shown))]


def _is_in(thing: Thing, world: World, room: Room) -> bool:
    """Whether a thing belongs to a room, as its first corner tells; doors do not."""
    x, y, z = world.building.quads[thing.quads.start].corners[0]
    on_level = room.base_m - 0.1 < z < room.base_m + room.ceiling_m
    inside = float(room.floor.distance(np.array([[x, y]]))[0]) == 0
    return on_level and inside and thing.name not in ("door", "window", "lamp")


def _pose(place: FloatArray, target: FloatArray, room: Room, tilt_deg: float = 0.0) -> FloatArray:
    way = target - place
    heading = np.array([np.arctan2(way[1], way[0])])
    position = np.array([[*place, room.base_m + EYE_M]])
    pitch = np.deg2rad([tilt_deg or -LOOK_DOWN_DEG])
    return np.asarray(camera_poses(position, heading, pitch, np.zeros(1))[0])


def _before_elevator(world: World) -> tuple[float, FloatArray]:
    """Return a time when the cabin stands open, and a place before it."""
    lift = world.building.plan.lift
    assert lift is not None
    ride = world.journey.rides[0]
    x = lift.floor.x0 if lift.door_side < 0 else lift.floor.x1
    place = np.array([x + lift.door_side * 1.0, lift.floor.centre[1]])
    way = np.array(lift.floor.centre) - place
    position = np.array([[*place, ride.start * world.building.plan.storey_m + EYE_M]])
    heading = np.array([np.arctan2(way[1], way[0])])
    T = camera_poses(position, heading, np.deg2rad([-10.0]), np.zeros(1))[0]
    return ride.closing_s - 0.2 * DOORS_S, T


def _shown(
    renderer: Renderer, eye: Eye, things: Sequence[Thing], room: Room, T: FloatArray
) -> float:
    """Return how much of a room is seen from a place: many of its things, and little else."""
    hits = renderer.look(eye, T).hits
    quads, counts = np.unique(hits.triangle[hits.triangle >= 0] // 2, return_counts=True)
    pixels = dict(zip(quads.tolist(), counts.tolist(), strict=True))
    score = 0.0
    for thing in things:
        shown = sum(pixels.get(quad, 0) for quad in range(thing.quads.start, thing.quads.stop))
        score += min(np.sqrt(shown), MOST_OF_ONE) if shown > 6 else 0.0
    depth = np.where(np.isfinite(hits.t), hits.t, 0)
    points = eye.rays.reshape(-1, 3) * depth.reshape(-1, 1) @ T[:3, :3].T + T[:3, 3]
    inside = float((room.floor.distance(points[:, :2]) < 0.2).mean())
    deep = float(np.clip(np.median(depth), 0, 3.0))
    return (score + 20 * deep) * inside**2 - 200 * float((depth < 0.7).mean())


def from_above(world: World, renderer: Renderer, level: int) -> Image:
    """Draw a level as seen from above, cut under its ceilings, with the names of its rooms."""
    plan = world.building.plan
    corners = np.concatenate([room.floor.polygon for room in plan.rooms])
    low, high = corners.min(axis=0) - 0.3, corners.max(axis=0) + 0.3
    columns, rows = ((high - low) * PLAN_PX_PER_M).astype(int)
    x = low[0] + (np.arange(columns) + 0.5) / PLAN_PX_PER_M
    y = high[1] - (np.arange(rows) + 0.5) / PLAN_PX_PER_M
    rays = np.zeros((int(rows), int(columns), 6), np.float32)
    rays[..., 0], rays[..., 1] = np.meshgrid(x, y)
    rays[..., 2], rays[..., 5] = level * plan.storey_m + CUT_M, -1.0
    hits = renderer.scene.cast(rays)
    missed = ~np.isfinite(hits.t) | (hits.t > CUT_M + 0.05)
    # All pixels are equally large, however far the surface is.
    even = Hits(np.ones_like(hits.t), hits.triangle, hits.uv, hits.normals)
    sight = Sight(even, np.abs(hits.normals[..., 2]))
    eye = Eye(rays[..., 3:], np.ones_like(hits.t), PLAN_PX_PER_M)
    colours, _ = renderer.colours(eye, sight, ("day",), 0.0, (0,))
    image = colours["day"].copy()
    image[missed] = (52, 52, 56)
    for room in plan.rooms:
        if room.level == level and not (room.part and room.label == "corridor"):
            at = (np.array(room.floor.centre) - low) * PLAN_PX_PER_M
            _write(image, room.name, (int(at[0]), int(rows - at[1])), centred=True)
    return image


def draw_page(world: World, progress: Callable[[int, int], None] | None = None) -> Image:
    """Draw the page: a title, the levels from above, the rooms by day and by night."""
    renderer, plan = make_renderer(world), world.building.plan
    total = len({room.name for room in plan.rooms})
    panels = []
    for done, view in enumerate(room_views(world, renderer), 1):
        panels.append(_panel(view))
        if progress is not None:
            progress(done, total)
    blank = np.full_like(panels[0], 255)
    panels += [blank] * (-len(panels) % COLUMNS)
    lines = [np.hstack(panels[i : i + COLUMNS]) for i in range(0, len(panels), COLUMNS)]
    width = lines[0].shape[1]
    levels = [from_above(world, renderer, level) for level in range(plan.levels)]
    parts = [_fitted(np.hstack(_level_row(levels)), width), *lines]
    title = np.full((40, width, 3), 255, np.uint8)
    s = world.settings
    words = (
        f"{s.plan}, seed {s.seed}, floors {plan.levels}, visit {s.visit}: each room by day, night"
    )
    cv2.putText(
        title, words, (MARGIN_PX, 27), cv2.FONT_HERSHEY_DUPLEX, 0.7, (30, 30, 34), 1, cv2.LINE_AA
    )
    return np.vstack([title, *parts])


def _level_row(levels: list[Image]) -> list[Image]:
    gap = np.full((levels[0].shape[0], 2 * MARGIN_PX, 3), 255, np.uint8)
    row = [levels[0]]
    for level in levels[1:]:
        row += [gap, level]
    return row


def _fitted(image: Image, width: int) -> Image:
    """Scale an image down to a width, or put it in the middle of one."""
    most = 620
    scale = min(width / image.shape[1], most / image.shape[0], 1.0)
    small = cv2.resize(image, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
    left = (width - small.shape[1]) // 2
    right = width - small.shape[1] - left
    white = (255, 255, 255)
    return np.asarray(
        cv2.copyMakeBorder(small, 0, MARGIN_PX, left, right, cv2.BORDER_CONSTANT, value=white)
    )


def _panel(view: RoomView) -> Image:
    """Put a room's two pictures side by side under its name."""
    pair = np.hstack(view.pictures)
    white = (255, 255, 255)
    framed = cv2.copyMakeBorder(
        pair, TITLE_PX, MARGIN_PX, MARGIN_PX // 2, MARGIN_PX // 2, cv2.BORDER_CONSTANT, value=white
    )
    cv2.putText(
        framed, view.room.name, (MARGIN_PX, TITLE_PX - 6), cv2.FONT_HERSHEY_SIMPLEX, 0.55,
        (30, 30, 34), 1, cv2.LINE_AA,
    )  # fmt: skip
    return np.asarray(framed)


def _write(image: Image, text: str, at: tuple[int, int], *, centred: bool) -> None:
    font, scale = cv2.FONT_HERSHEY_SIMPLEX, 0.5
    (wide, tall), _ = cv2.getTextSize(text, font, scale, 1)
    x = at[0] - wide // 2 if centred else at[0]
    cv2.rectangle(image, (x - 3, at[1] - tall - 3), (x + wide + 3, at[1] + 4), (255, 255, 255), -1)
    cv2.putText(image, text, (x, at[1]), font, scale, (20, 20, 24), 1, cv2.LINE_AA)
