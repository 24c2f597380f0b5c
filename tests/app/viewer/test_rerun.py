"""A recording is made, verified by Rerun's own tool, and read back."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from rerun.chunk import RrdReader
from scipy.spatial.transform import Rotation

from roomgraph.app.errors import AppError
from roomgraph.app.viewer.graph import place_spots
from roomgraph.app.viewer.images import encode_depth, has_depth, thinned
from roomgraph.app.viewer.rerun import RerunViewer, ViewerSettings, thinned_map
from roomgraph.app.viewer.viewer import MapView, SessionView
from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.frame import Frame
from roomgraph.datasets.se3 import pose, transform
from roomgraph.semantics.graph.graph import (
    Doorway,
    EdgeKind,
    GraphEdge,
    GraphNode,
    RoomPolygon,
    SemanticGraph,
)
from roomgraph.semantics.labels import LabelSpace
from roomgraph.slam.reconstruction.point_map import PointMap
from roomgraph.slam.tracking import Anchor, LoopClosure, Tracking, TrackingState

pytestmark = pytest.mark.slow

N_FRAMES, LOST = 12, 5
CAMERA = Intrinsics(64, 48, 60.0, 60.0, 31.5, 23.5)
LABELS = LabelSpace.of(["kitchen", "office"])
T_MAP_WORLD = pose(Rotation.from_euler("XZ", [-90, 30], degrees=True).as_matrix(), [1, 2, 1.5])
# Bytes that a recording may take: once, for each frame of 64 x 48, for each point of each map.
BOUND_FIXED, BOUND_A_FRAME, BOUND_A_POINT = 128 * 1024, 10 * 1024, 32
# And for each picture of a keyframe: 128 x 96 in three colours.
BOUND_A_PICTURE = 40 * 1024


def frame_of(index: int) -> Frame:
    rng = np.random.default_rng(index)
    colour = rng.integers(0, 255, (48, 64, 3), dtype=np.uint8)
    depth = np.full((48, 64), 2.5, np.float32)
    depth[:, :32] = 0
    return Frame(index, 100.0 + index / 10, colour, depth, CAMERA)


def tracking_of(index: int) -> Tracking:
    state = TrackingState.LOST if index == LOST else TrackingState.OK
    state = TrackingState.RELOCALISED if index == LOST + 1 else state
    pixels = np.array([[5.0, 5.0], [60.0, 40.0], [50.0, 20.0]])
    T = true_pose(index) if state.has_pose else None
    closures = (LoopClosure(9, 0, 40),) if index == 9 else ()
    return Tracking(
        index, 100.0 + index / 10, state, 20 + index, "features",
        None if T is None else Anchor(index // 3 * 3, np.eye(4)), T, index % 3 == 0, closures,
        pixels,
    )  # fmt: skip


def true_pose(index: int) -> np.ndarray:
    R = Rotation.from_euler("YX", [10 * index, -20], degrees=True).as_matrix()
    return pose(R, [0.2 * index, 0.0, 0.1 * index])


def map_of(frames: int) -> MapView:
    rng = np.random.default_rng(0)
    points = rng.uniform(-3, 3, (2000, 3)).astype(np.float32)
    colours = rng.integers(0, 255, (2000, 3), dtype=np.uint8)
    shown = tuple(i for i in range(frames) if i != LOST)
    poses = np.array([true_pose(i) for i in shown])
    keyframes = tuple(i for i in shown if i % 3 == 0)
    T_keyframes = np.array([true_pose(i) for i in keyframes])
    constraints = np.stack([T_keyframes[:-1, :3, 3], T_keyframes[1:, :3, 3]], axis=1)
    return MapView(
        PointMap(points, colours, np.zeros(2000, np.int32), np.zeros_like(points)),
        rng.integers(0, 3, 2000).astype(np.uint16), keyframes, T_keyframes, constraints,
        constraints[:1], poses[:, :3, 3], shown, tuple(tracking_of(i).state for i in shown),
    )  # fmt: skip


def graph_of(n: int) -> SemanticGraph:
    nodes = tuple(
        GraphNode(
            i, i * 3, 100 + i * 0.3, true_pose(i * 3)[:3, 3], LABELS.names[1 + i // 2], 1 + i // 2,
            f"{LABELS.names[1 + i // 2]}1", 0.9, np.empty(0),
        )
        for i in range(n)
    )  # fmt: skip
    edges = tuple(GraphEdge(i, i + 1, 0.6, EdgeKind.PATH) for i in range(n - 1))
    return SemanticGraph(LABELS, nodes, edges)


def with_rooms(graph: SemanticGraph) -> SemanticGraph:
    """Two rooms of 3 x 4 m side by side, a door of 0.9 m in the wall x = 3 between them."""
    square = np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 4.0], [0.0, 4.0]])
    rooms = tuple(
        RoomPolygon(
            f"{LABELS.names[i]}1", LABELS.names[i], i, 0.9, outline, 12.0, outline.mean(axis=0)
        )
        for i, outline in ((1, square), (2, square + np.array([3.0, 0.0])))
    )
    door = Doorway(("kitchen1", "office1"), np.array([3.0, 2.0]), 0.9)
    return replace(graph, rooms=rooms, doorways=(door,), T_map_world=T_MAP_WORLD)


@dataclass
class Recorded:
    """A recording's rows by entity: component -> values, with frames and stamps."""

    rows: dict[str, list[dict[str, Any]]] = field(default_factory=dict)

    @classmethod
    def read(cls, path: Path) -> Recorded:
        recorded = cls()
        for chunk in RrdReader(path).store().stream():
            rows = recorded.rows.setdefault(chunk.entity_path, [])
            rows.extend(chunk.to_record_batch().to_pylist())
        return recorded

    def values(self, entity: str, component: str) -> dict[int, Any]:
        """Of a component, by frame; None stands for static."""
        return {
            row.get("frame"): row[component] for row in self.rows[entity]
            if row.get(component) is not None
        }  # fmt: skip


def record(path: Path, settings: ViewerSettings | None = None) -> None:
    viewer = RerunViewer(path, settings=settings)
    truth = np.array([true_pose(i)[:3, 3] for i in range(N_FRAMES)])
    viewer.start(SessionView("test", N_FRAMES, CAMERA, LABELS, truth))
    for i in range(N_FRAMES):
        if i == 9:
            viewer.log(i, "loop closed")
        viewer.show_frame(frame_of(i), tracking_of(i))
        if i >= 2:
            viewer.show_label(i - 2, 1 + i // 8, LABELS.names[1 + i // 8], 0.5 + i / 100)
        if i in (0, 9):
            viewer.show_map(i, lambda i=i: map_of(i + 1))
        if i % 3 == 0:
            viewer.show_graph(i, graph_of(i // 3 + 1))
    viewer.show_map(N_FRAMES - 1, lambda: map_of(N_FRAMES))
    viewer.show_graph(N_FRAMES - 1, with_rooms(graph_of(4)))
    viewer.close()


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("rerun") / "recording.rrd"
    record(path)
    return path


@pytest.fixture(scope="module")
def recorded(recording: Path) -> Recorded:
    return Recorded.read(recording)


def test_rerun_verifies_it(recording: Path) -> None:
    command = [sys.executable, "-m", "rerun", "rrd", "verify", str(recording)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0, done.stderr


def test_everything_shown_is_there(recorded: Recorded) -> None:
    world = {
        "camera", "camera/image", "camera/image/colour", "camera/image/features/with_depth",
        "camera/image/features/plain", "camera/depth", "camera/depth/image", "map/colour",
        "map/labels", "map/above", "trajectory/estimate", "trajectory/recent", "trajectory/truth",
        "keyframes", "pose_graph/constraints", "pose_graph/loops", "graph/nodes", "graph/edges",
        "graph/places", "graph/rooms", "graph/doors",
    }  # fmt: skip
    others = {
        "graph", "graph/places", "plots/inliers", "plots/score", "timeline/label",
        "timeline/tracking", "events", "status",
    }  # fmt: skip
    wanted = {f"/world/{name}" for name in world} | {f"/{name}" for name in others} | {"/world"}
    assert wanted <= set(recorded.rows)


def test_images_are_there_with_their_stamps(recorded: Recorded) -> None:
    jpegs = recorded.values("/world/camera/image/colour", "EncodedImage:blob")
    lost_and_found = {LOST, LOST + 1, LOST + 2}
    assert set(jpegs) == {0, 2, 4, 9, 11} | lost_and_found  # else 0.2 s apart, on average
    corners = recorded.values("/world/camera/image/features/with_depth", "Points2D:positions")
    assert set(corners) == set(jpegs)
    depths = recorded.values("/world/camera/depth/image", "EncodedDepthImage:blob")
    assert set(depths) == {0, 4, 11} | lost_and_found  # and 0.4 s
    images = recorded.rows["/world/camera/image/colour"]
    stamps = {row["frame"]: row["stamp"] for row in images if "frame" in row}
    assert stamps[6].total_seconds() == pytest.approx(100.6)


def test_what_all_images_have_alike_is_there_once(recorded: Recorded) -> None:
    depth = "/world/camera/depth/image"
    assert recorded.values(depth, "EncodedDepthImage:meter") == {None: [100.0]}
    assert recorded.values(depth, "EncodedDepthImage:media_type") == {None: ["image/png"]}
    assert recorded.values(depth, "EncodedDepthImage:depth_range") == {None: [[0.0, 500.0]]}
    colour = "/world/camera/image/colour"
    assert recorded.values(colour, "EncodedImage:media_type") == {None: ["image/jpeg"]}
    for kind in ("plain", "with_depth"):
        entity = f"/world/camera/image/features/{kind}"
        assert set(recorded.values(entity, "Points2D:colors")) == {None}
        assert set(recorded.values(entity, "Points2D:radii")) == {None}


def test_poses_come_back(recorded: Recorded) -> None:
    translations = recorded.values("/world/camera", "Transform3D:translation")
    rotations = recorded.values("/world/camera", "Transform3D:mat3x3")
    assert sorted(translations) == [0, 2, 4, 6, 7, 9, 11]  # of the frames that are shown
    for i, translation in translations.items():
        np.testing.assert_allclose(translation[0], true_pose(i)[:3, 3], atol=1e-6)
        R = np.reshape(rotations[i][0], (3, 3)).T  # Rerun's matrices are column-major.
        np.testing.assert_allclose(R, true_pose(i)[:3, :3], atol=1e-6)


def test_labels_come_back(recorded: Recorded) -> None:
    view = map_of(N_FRAMES)
    positions = recorded.values("/world/map/labels", "Points3D:positions")[N_FRAMES - 1]
    ids = recorded.values("/world/map/labels", "Points3D:class_ids")[N_FRAMES - 1]
    known = {
        tuple(p): i for p, i in zip(view.points.points_world.tolist(), view.label_ids, strict=True)
    }
    assert 0 < len(positions) < len(view.points)
    assert [known[tuple(p)] for p in positions] == ids
    scores = recorded.values("/plots/score", "Scalars:scalars")
    assert scores[4] == [pytest.approx(0.56)]
    changes = recorded.values("/timeline/label", "StateChange:state")
    assert changes == {0: ["kitchen"], 6: ["office"]}
    (context,) = recorded.values("/world", "AnnotationContext:context").values()
    infos = [entry["class_description"]["info"] for entry in context[0]]
    assert {info["id"]: info["label"] for info in infos} == dict(enumerate(LABELS.names))


def test_what_hides_the_rooms_is_apart(recorded: Recorded) -> None:
    last = N_FRAMES - 1
    low = recorded.values("/world/map/colour", "Points3D:positions")[last]
    high = recorded.values("/world/map/above", "Points3D:positions")[last]
    assert len(low) + len(high) == 2000
    assert min(-p[1] for p in high) > np.mean([-p[1] for p in low])


def test_states_are_told_and_coloured(recorded: Recorded) -> None:
    states = recorded.values("/timeline/tracking", "StateChange:state")
    assert states == {0: ["ok"], LOST: ["lost"], LOST + 1: ["relocalised"], LOST + 2: ["ok"]}
    strips = recorded.values("/world/trajectory/estimate", "LineStrips3D:strips")[N_FRAMES - 1]
    assert [len(strip) for strip in strips] == [5, 2, 6]  # tracked, lost, tracked
    assert recorded.values("/events", "TextLog:text") == {9: ["loop closed"]}


def test_the_graph_names_each_place_once(recorded: Recorded) -> None:
    assert recorded.values("/graph", "GraphNodes:node_ids")[9] == ["0", "1", "2", "3"]
    assert recorded.values("/graph/places", "GraphNodes:labels")[9] == ["kitchen1", "office1"]
    dots = recorded.values("/graph", "GraphNodes:positions")[9]
    assert recorded.values("/graph/places", "GraphNodes:positions")[9] == [dots[0], dots[2]]
    assert recorded.values("/world/graph/places", "Points3D:labels")[9] == ["kitchen1", "office1"]
    nodes = recorded.values("/world/graph/nodes", "Points3D:labels")[9]
    assert nodes == ["kitchen1", "kitchen1", "office1", "office1"]


def test_the_plan_lies_across_and_keeps_its_distances(recorded: Recorded) -> None:
    plan = np.array(recorded.values("/graph", "GraphNodes:positions")[9])
    assert np.ptp(plan[:, 0]) >= np.ptp(plan[:, 1])
    steps = np.linalg.norm(np.diff(plan, axis=0), axis=1)
    true = np.diff([true_pose(i * 3)[:3, 3] for i in range(4)], axis=0)
    on_floor = np.linalg.norm(true, axis=1)
    assert np.allclose(steps / on_floor, (steps / on_floor)[0], rtol=0.05)


def test_with_a_floor_plan_the_graph_lies_as_it_does(recorded: Recorded) -> None:
    shown = np.array(recorded.values("/graph", "GraphNodes:positions")[N_FRAMES - 1])
    centres = np.array([true_pose(i * 3)[:3, 3] for i in range(4)])
    on_map = transform(T_MAP_WORLD, centres)[:, :2] * (1, -1)
    steps, true = np.diff(shown, axis=0), np.diff(on_map, axis=0)
    scale = np.linalg.norm(steps) / np.linalg.norm(true)
    np.testing.assert_allclose(steps, scale * true, atol=1e-3 * scale)


def test_rooms_are_outlined_on_the_floor_with_their_doors(recorded: Recorded) -> None:
    last = N_FRAMES - 1
    rooms = recorded.values("/world/graph/rooms", "LineStrips3D:strips")[last]
    outlines = [transform(T_MAP_WORLD, np.array(room)) for room in rooms]
    assert [len(outline) for outline in outlines] == [5, 5]
    assert np.allclose(outlines[1].max(axis=0)[:2], (6, 4), atol=1e-5)
    assert all((np.abs(outline[:, 2]) < 0.05).all() for outline in outlines)
    labels = recorded.values("/world/graph/rooms", "LineStrips3D:labels")[last]
    assert labels == ["kitchen1: 12.0 m²", "office1: 12.0 m²"]
    (strip,) = recorded.values("/world/graph/doors", "LineStrips3D:strips")[last]
    door = transform(T_MAP_WORLD, np.array(strip))
    assert np.allclose(door[:, 0], 3.0, atol=1e-5)
    assert (door[:, 1].min(), door[:, 1].max()) == pytest.approx((1.55, 2.45), abs=1e-5)
    assert (door[:, 2].min(), door[:, 2].max()) == pytest.approx((0.0, 2.0), abs=1e-5)


def test_keyframes_stand_where_they_are_with_their_pictures(recorded: Recorded) -> None:
    pictures = {name for name in recorded.rows if name.startswith("/world/keyframes/")}
    assert pictures == {"/world/keyframes/0", "/world/keyframes/9"}  # 2 m apart, 1.5 at least
    for keyframe, shown_at in ((0, 0), (9, 9)):
        entity = f"/world/keyframes/{keyframe}"
        buffers = recorded.values(entity, "Mesh3D:albedo_texture_buffer")
        assert list(buffers) == [shown_at]
        picture = np.array(buffers[shown_at][0], dtype=np.uint8).reshape(96, 128, 3)
        wanted = cv2.resize(frame_of(keyframe).colour, (128, 96), interpolation=cv2.INTER_AREA)
        np.testing.assert_array_equal(picture, wanted)
        corners = np.array(recorded.values(entity, "Mesh3D:vertex_positions")[shown_at])
        outline = [(-0.5, -0.5), (63.5, -0.5), (63.5, 47.5), (-0.5, 47.5)]
        np.testing.assert_allclose(CAMERA.project(corners), outline, atol=1e-4)
        translation = recorded.values(entity, "Transform3D:translation")[shown_at][0]
        np.testing.assert_allclose(translation, true_pose(keyframe)[:3, 3], atol=1e-6)


def test_a_picture_moves_with_its_keyframe_and_is_not_drawn_twice(tmp_path: Path) -> None:
    viewer = RerunViewer(tmp_path / "moved.rrd")
    viewer.start(SessionView("moved", N_FRAMES, CAMERA, LABELS, None))
    viewer.show_frame(frame_of(0), tracking_of(0))
    before = map_of(1)
    for i, shift in enumerate((0.0, 0.001, 0.5)):
        T = before.T_world_keyframe.copy()
        T[:, 0, 3] += shift
        viewer.show_map(i, lambda T=T: replace(before, T_world_keyframe=T))
    viewer.close()
    recorded = Recorded.read(tmp_path / "moved.rrd")
    translations = recorded.values("/world/keyframes/0", "Transform3D:translation")
    assert {i: t[0][0] for i, t in translations.items()} == {0: 0.0, 2: 0.5}
    assert list(recorded.values("/world/keyframes/0", "Mesh3D:vertex_positions")) == [0]


def test_a_label_is_told_of_its_own_frame(recorded: Recorded) -> None:
    words = recorded.values("/status", "TextDocument:text")
    assert words[2][0].startswith("# kitchen · 0.54\n\nframe 3 of 12 · **ok** · 22 inliers")
    assert words[6][0].startswith("# office · 0.58")
    assert N_FRAMES - 1 not in words  # its label has not come


def test_poses_in_a_submap_are_not_drawn_in_the_world(tmp_path: Path) -> None:
    viewer = RerunViewer(tmp_path / "apart.rrd")
    viewer.start(SessionView("apart", N_FRAMES, CAMERA, LABELS, None))
    for i in range(5):
        tracking = tracking_of(i)
        viewer.show_frame(
            frame_of(i), replace(tracking, T_world_camera=None) if i > 2 else tracking
        )
        viewer.show_label(i, 1, "kitchen", 0.5)
    viewer.close()
    recorded = Recorded.read(tmp_path / "apart.rrd")
    assert sorted(recorded.values("/world/camera", "Transform3D:translation")) == [0, 2]
    assert sorted(recorded.values("/world/trajectory/recent", "LineStrips3D:strips")) == [0, 2]
    states = recorded.values("/timeline/tracking", "StateChange:state")
    assert states == {0: ["ok"], 3: ["sub-map"]}
    assert "**sub-map**" in recorded.values("/status", "TextDocument:text")[3][0]


def test_without_labels_nothing_is_said_of_them(tmp_path: Path) -> None:
    viewer = RerunViewer(tmp_path / "plain.rrd")
    viewer.start(SessionView("plain", 1, CAMERA, LabelSpace(), None))
    viewer.show_frame(frame_of(0), tracking_of(0))
    viewer.show_label(0, 0, "unknown", 0.0)
    viewer.close()
    recorded = Recorded.read(tmp_path / "plain.rrd")
    assert "/timeline/label" not in recorded.rows
    (words,) = recorded.values("/status", "TextDocument:text")[0]
    assert "places not labelled" in words
    assert "unknown" not in words


def test_nodes_of_unknown_place_have_no_name() -> None:
    known = graph_of(2)
    unknown = tuple(replace(node, place="unknown") for node in known.nodes[1:])
    assert place_spots(replace(known, nodes=(known.nodes[0], *unknown))) == {"kitchen1": 0}


def test_it_stays_small(recording: Path) -> None:
    points = 4 * 2000  # three maps, the last of them once more by close()
    bound = BOUND_FIXED + N_FRAMES * BOUND_A_FRAME + points * BOUND_A_POINT
    bound += 2 * BOUND_A_PICTURE
    assert recording.stat().st_size < bound


def test_maps_are_thinned_and_left_out_when_too_many(tmp_path: Path) -> None:
    path = tmp_path / "thin.rrd"
    record(
        path,
        ViewerSettings(max_points=1000, max_points_total=0, frame_every_s=0.25, depth_every_s=0.0),
    )
    recorded = Recorded.read(path)
    rows = recorded.rows["/world/map/colour"]
    above = recorded.rows["/world/map/above"]
    sizes = [
        len(a["Points3D:positions"]) + len(b["Points3D:positions"])
        for a, b in zip(rows, above, strict=True)
    ]
    assert sizes == [1000, 2000]  # the first, and the last one in full
    paths = recorded.values("/world/trajectory/estimate", "LineStrips3D:strips")
    assert sorted(paths) == [0, 9, N_FRAMES - 1]
    jpegs = recorded.values("/world/camera/image/colour", "EncodedImage:blob")
    assert sorted(jpegs) == [0, 3, LOST, LOST + 1, LOST + 2, 10, N_FRAMES - 1]
    depths = recorded.values("/world/camera/depth/image", "EncodedDepthImage:blob")
    assert sorted(depths) == sorted(jpegs)


def test_a_run_without_a_single_pose_can_be_closed(tmp_path: Path) -> None:
    viewer = RerunViewer(tmp_path / "empty.rrd")
    viewer.start(SessionView("empty", 1, CAMERA, LabelSpace(), None))
    nothing, none = np.empty((0, 3)), np.empty((0, 3), np.float32)
    points = PointMap(none, none.astype(np.uint8), np.empty(0, np.int32), none)
    ends = np.empty((0, 2, 3))
    none_yet = (), np.empty((0, 4, 4)), ends, ends, nothing, (), ()
    empty = MapView(points, np.empty(0, np.uint16), *none_yet)
    viewer.show_frame(frame_of(LOST), tracking_of(LOST))
    viewer.show_map(0, lambda: empty)
    viewer.show_graph(0, SemanticGraph(LabelSpace(), (), ()))
    viewer.show_label(LOST, 0, "unknown", 0.0)
    viewer.close()
    assert "/status" in Recorded.read(tmp_path / "empty.rrd").rows


def test_errors_say_what_to_do(tmp_path: Path) -> None:
    with pytest.raises(AppError, match="NoViewer"):
        RerunViewer(None)
    viewer = RerunViewer(tmp_path / "missing" / "folder" / "a.rrd")
    with pytest.raises(AppError, match=r"a\.rrd"):
        viewer.start(SessionView("x", 1, CAMERA, LABELS, None))


def test_thinned_images_and_maps_keep_their_geometry() -> None:
    small = thinned(CAMERA, 2)
    assert (small.width, small.height, small.fx) == (32, 24, 30.0)
    frame = frame_of(0)
    assert len(encode_depth(frame, 2)) < len(encode_depth(frame, 1))
    pixels = np.array([[5.0, 5.0], [60.0, 40.0], [63.4, 47.4]])
    np.testing.assert_array_equal(has_depth(frame, pixels), [False, True, True])
    view = thinned_map(map_of(4), 100)
    assert len(view.points) == len(view.label_ids) == len(view.points.keyframes) == 100
