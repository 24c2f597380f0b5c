"""How the recording is laid out on the screen."""

from __future__ import annotations

import rerun.blueprint as rrb

from app.rerun_framing import Framing

BACKGROUND = (16, 18, 22)


def build_blueprint(framing: Framing | None) -> rrb.Blueprint:
    """Lay out maps, images, graph, plots and events side by side.

    Parameters
    ----------
    framing : Framing or None
        Where the maps are seen from; None leaves it to the viewer, which follows the scene's size.
    """
    top = rrb.Horizontal(
        _map_view("Map", ["+ /world/**", "- /world/map/labels"], framing),
        _map_view("Map by label", ["+ /world/**", "- /world/map/colour"], framing),
        rrb.Vertical(
            rrb.Spatial2DView(name="Camera", origin="/world/camera/image"),
            rrb.Spatial2DView(name="Depth", origin="/world/camera/depth"),
        ),
        column_shares=[3, 3, 1.6],
    )
    bottom = rrb.Horizontal(
        rrb.GraphView(name="Places", origin="/graph"),
        rrb.Vertical(
            rrb.StateTimelineView(name="Label and state", origin="/timeline"),
            rrb.TimeSeriesView(
                name="Label score", origin="/plots/score",
                axis_y=rrb.ScalarAxis(range=(0.0, 1.05), zoom_lock=True),
            ),
        ),
        rrb.TimeSeriesView(name="Inliers", origin="/plots/inliers"),
        rrb.Vertical(
            rrb.TextDocumentView(name="Now", origin="/status"),
            rrb.TextLogView(name="Events", origin="/events"),
            row_shares=[2, 3],
        ),
        column_shares=[2, 2.4, 1.6, 1.6],
    )  # fmt: skip
    return rrb.Blueprint(
        rrb.Vertical(top, bottom, row_shares=[2, 1]),
        rrb.BlueprintPanel(state="collapsed"),
        rrb.SelectionPanel(state="collapsed"),
        rrb.TimePanel(state="collapsed", timeline="frame", play_state="following"),
        auto_views=False,
    )


def _map_view(name: str, contents: list[str], framing: Framing | None) -> rrb.Spatial3DView:
    eye = rrb.EyeControls3D() if framing is None else rrb.EyeControls3D(
        kind="orbital", position=framing.eye, look_target=framing.target, eye_up=framing.up,
    )  # fmt: skip
    return rrb.Spatial3DView(
        name=name, origin="/world", contents=[*contents, "- /world/camera/depth/**"],
        background=BACKGROUND, line_grid=False, eye_controls=eye,
        overrides={"/world/map/above": rrb.EntityBehavior(visible=False)},
    )  # fmt: skip
