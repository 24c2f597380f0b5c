"""Answers about a map in plain English and as JSON values."""

from __future__ import annotations

from typing import Any

from rich.table import Table

from roomgraph.app.answers.locating import Whereabouts, position_map
from roomgraph.app.answers.speech import spoken
from roomgraph.semantics.graph.graph import SemanticGraph
from roomgraph.semantics.graph.routing import Leg, Route, turning
from roomgraph.semantics.graph.visits import PlaceSummary
from roomgraph.semantics.labels import UNKNOWN


def places_table(places: tuple[PlaceSummary, ...], start_s: float) -> Table:
    """Return a table of places; times count from the start of the run."""
    table = Table(box=None, padding=(0, 1, 0, 0))
    for title in ("place", "label", "sure", "nodes", "area", "visits", "first", "last"):
        is_word = title in ("place", "label")
        table.add_column(title, justify="left" if is_word else "right", no_wrap=is_word)
    for place in places:
        area = "" if place.area_m2 is None else f"{place.area_m2:.1f} m²"
        first, last = place.visits[0].first_s - start_s, place.visits[-1].last_s - start_s
        table.add_row(
            place.name, "-" if place.label == UNKNOWN else place.label,
            f"{place.score:.0%}" if place.score else "-", str(len(place.nodes)), area,
            str(len(place.visits)), f"{first:.1f} s", f"{last:.1f} s",
        )  # fmt: skip
    return table


def places_json(places: tuple[PlaceSummary, ...]) -> list[dict[str, Any]]:
    """Return places as JSON values: stamps in seconds as in the sequence, areas in m²."""
    return [
        {
            "place": p.name, "label": p.label, "probability": round(p.score, 4),
            "nodes": list(p.nodes), "area_m2": None if p.area_m2 is None else round(p.area_m2, 3),
            "visits": [{"first_s": v.first_s, "last_s": v.last_s} for v in p.visits],
        }
        for p in places
    ]  # fmt: skip


def route_text(route: Route) -> str:
    """Return a route in sentences, one per line."""
    start, goal = route.legs[0], route.legs[-1]
    if len(route.legs) == 1:
        return f"Stay in {start.place}: {route.length_m:.1f} m."
    lines = [f"From {start.place} to {goal.place}: {route.length_m:.1f} m."]
    for number, leg in enumerate(route.legs, 1):
        lines.append(f"{number}. {_leg_text(leg, route.legs[number:])}")
    return "\n".join(lines)


def _leg_text(leg: Leg, rest: tuple[Leg, ...]) -> str:
    inside = f"In {leg.place} go {leg.length_m:.1f} m"
    if not rest:
        return f"{inside} to the goal."
    way = "" if leg.turn_deg is None else turning(leg.turn_deg)
    way = way if way == "straight on" else f"turn {way}"
    if leg.door is None:
        return f"{inside}, then {way} into {rest[0].place}."
    width = "" if leg.door.width_m is None else f" ({leg.door.width_m:.1f} m wide)"
    return f"{inside} to the door{width}, then {way} into {rest[0].place}."


def route_json(route: Route) -> dict[str, Any]:
    """Return a route as JSON values: metres, degrees (left positive)."""
    return {
        "length_m": round(route.length_m, 3),
        "nodes": list(route.nodes),
        "legs": [
            {
                "place": leg.place, "label": leg.label, "length_m": round(leg.length_m, 3),
                "door": None if leg.door is None else {
                    "position_map": leg.door.position_map.round(3).tolist(),
                    "width_m": leg.door.width_m,
                },
                "turn_deg": None if leg.turn_deg is None else round(leg.turn_deg, 1),
            }
            for leg in route.legs
        ],
    }  # fmt: skip


def whereabouts_text(graph: SemanticGraph, where: Whereabouts) -> str:
    """Return an answer as a sentence."""
    if where.place == UNKNOWN and where.T_world_camera is None:
        return "Place not recognised."
    sure = f"{where.sureness:.0%} sure"
    text = f"You are in {spoken(where.place)} ({sure}), nearest node {where.node}"
    if where.T_world_camera is None:
        return f"{text}; recognised by appearance only, without a pose."
    pose = position_map(graph, where)
    if pose is None:
        x, y, z = where.T_world_camera[:3, 3]
        return f"{text}, at x {x:z.2f} y {y:z.2f} z {z:z.2f} m in the world frame."
    x, y, heading = pose
    return f"{text}, on the map at x {x:z.2f} y {y:z.2f} m, heading {heading:z.0f}°."


def whereabouts_json(graph: SemanticGraph, name: str, where: Whereabouts) -> dict[str, Any]:
    """Return an answer as JSON values: metres, degrees."""
    T, pose = where.T_world_camera, position_map(graph, where)
    return {
        "item": name, "place": where.place, "label": where.label, "node": where.node,
        "sureness": round(where.sureness, 4), "inliers": where.inliers,
        "T_world_camera": None if T is None else T.round(6).tolist(),
        "map": None if pose is None else {
            "x": round(pose[0], 4), "y": round(pose[1], 4), "heading_deg": round(pose[2], 2)
        },
    }  # fmt: skip
