"""Layout of the recording in the Rerun viewer."""

from __future__ import annotations

import rerun.blueprint as rrb

from roomgraph.app.viewer.framing import Framing
from roomgraph.app.viewer.graph import PLAN_SIZE

BACKGROUND = (16, 18, 22)
_CAMERA = ("+ /world/camera", "+ /world/camera/image", "+ /world/camera/image/colour")
_PATH = ("+ /world/trajectory/**", "+ /world/pose_graph/**", "+ /world/keyframes/**")
_NAMES = ("+ /world/graph/places", "+ /world/graph/doors")


def build_blueprint(framing: Framing | None, labelled: bool) -> rrb.Blueprint:
    """Lay out maps, images, graph, plots and events side by side.

    Parameters
    ----------
    framing : Framing or None
        Where the maps are seen from; None leaves it to the viewer, which follows the scene's size.
    labelled : bool
        Whether there are labels; what only shows them is left out if not.
    """
    return rrb.Blueprint(
        rrb.Vertical(_maps(framing, labelled), _details(labelled), row_shares=[2, 1]),
        rrb.BlueprintPanel(state="collapsed"),
        rrb.SelectionPanel(state="collapsed"),
        rrb.TimePanel(state="collapsed", timeline="frame", play_state="following"),
        auto_views=False,
    )


def _maps(framing: Framing | None, labelled: bool) -> rrb.Horizontal:
    coloured = ["+ /world/map/colour", "+ /world/map/above", *_PATH, *_NAMES]
    rooms = ["+ /world/map/labels", "+ /world/graph/**"]
    return rrb.Horizontal(
        _map_view("Map · path blue, ground truth yellow, loops pink", coloured, framing),
        _map_view(
            f"{'Map by label' if labelled else 'Rooms'} · doors orange, graph white", rooms, framing
        ),
        rrb.Vertical(
            rrb.Spatial2DView(name="Camera", origin="/world/camera/image"),
            rrb.Spatial2DView(
                name="Depth · blue near, red far, black unknown", origin="/world/camera/depth"
            ),
        ),
        column_shares=[3, 3, 1.6],
    )


def _details(labelled: bool) -> rrb.Horizontal:
    width, height = PLAN_SIZE
    bounds = rrb.VisualBounds2D(
        x_range=(-1.25 * width, 1.25 * width), y_range=(-1.15 * height, 1.15 * height)
    )
    score = rrb.ScalarAxis(range=(0.0, 1.05), zoom_lock=True)
    name = "Online label and tracking" if labelled else "Tracking"
    over_time = (
        rrb.StateTimelineView(name=name, origin="/timeline"),
        rrb.TimeSeriesView(name="Probability of the label", origin="/plots/score", axis_y=score),
    )
    return rrb.Horizontal(
        rrb.GraphView(name="Places", origin="/graph", visual_bounds=bounds),
        rrb.Vertical(*over_time) if labelled else over_time[0],
        rrb.TimeSeriesView(name="Inlier matches", origin="/plots/inliers"),
        rrb.Vertical(
            rrb.TextDocumentView(name="Current frame", origin="/status"),
            rrb.TextLogView(
                name="Events", origin="/events", columns=_event_columns(),
            ),
            row_shares=[2, 3],
        ),
        column_shares=[2, 2.4, 1.3, 1.9],
    )  # fmt: skip


def _event_columns() -> rrb.TextLogColumns:
    return rrb.TextLogColumns(timeline_columns=["frame"], text_log_columns=["Body"])


def _map_view(name: str, contents: list[str], framing: Framing | None) -> rrb.Spatial3DView:
    eye = None if framing is None else rrb.EyeControls3D(
        kind="orbital", position=framing.eye, look_target=framing.target, eye_up=framing.up,
    )  # fmt: skip
    return rrb.Spatial3DView(
        name=name, origin="/world", background=BACKGROUND, line_grid=False, eye_controls=eye,
        contents=[*contents, *_CAMERA],
        overrides={"/world/map/above": rrb.EntityBehavior(visible=False)},
    )  # fmt: skip
