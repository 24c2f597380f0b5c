"""Every format, opened again by a library that its users use."""

import csv
import json
import shutil
import struct
import sys

import networkx
import numpy as np
import pytest

from roomgraph.app.errors import AppError
from roomgraph.app.export.registry import EXPORTERS
from roomgraph.app.storage.cloud import read_cloud
from roomgraph.app.storage.occupancy import read_occupancy
from roomgraph.app.storage.run_folder import RunFolder
from roomgraph.datasets import se3
from roomgraph.datasets.trajectory import read_kitti, read_tum
from roomgraph.semantics.graph.files import read_graph_json
from tests.app.command import roomgraph

ENDS = {"kitti": ".txt", "graphml": ".graphml", "dot": ".dot", "graph-csv": ".csv",
        "hydra": ".json", "mesh-ply": ".ply", "nav2": ".yaml"}  # fmt: skip


@pytest.fixture
def run(mapped):
    return RunFolder(mapped[1])


@pytest.fixture
def export(run, tmp_path, monkeypatch):
    """Export a format into a new folder; return the path."""

    def write(name, folder=None):
        path = tmp_path / f"product{ENDS.get(name, f'.{name}')}"
        root = (folder or run).root
        assert roomgraph(monkeypatch, "export", root, name, "-o", path, "--quiet") == 0
        return path

    return write


@pytest.mark.parametrize("name", list(EXPORTERS))
def test_a_format_is_written_whole_and_not_overwritten_unasked(
    run, export, tmp_path, monkeypatch, name
):
    path = export(name)
    files = (path, *EXPORTERS[name].beside(path))
    assert sorted(p.name for p in tmp_path.iterdir()) == sorted(p.name for p in files)
    assert all(p.stat().st_size > 0 for p in files)
    for written in files:
        others = [p for p in files if p != written]
        for other in others:
            other.unlink()
        assert roomgraph(monkeypatch, "export", run.root, name, "-o", path, "--quiet") == 1
        arguments = ("export", run.root, name, "-o", path, "--quiet", "--overwrite")
        assert roomgraph(monkeypatch, *arguments) == 0


@pytest.mark.parametrize(
    ("name", "module", "package"),
    [("e57", "pye57", "pye57"), ("hydra", "spark_dsg", "spark-dsg")],
)
def test_a_package_that_is_missing_is_named_as_pip_knows_it(
    run, tmp_path, monkeypatch, name, module, package
):
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(AppError, match=f"pip install {package}$"):
        EXPORTERS[name].write(run, tmp_path / EXPORTERS[name].file_name)
    assert f"(pip install {package})" in EXPORTERS[name].meaning


def test_formats_are_listed(monkeypatch, capsys):
    assert roomgraph(monkeypatch, "export", "--list") == 0
    listed = [line.split()[0] for line in capsys.readouterr().out.splitlines()]
    assert listed == list(EXPORTERS)


def test_trajectories_in_evo(run, export):
    from evo.tools import file_interface

    tum = file_interface.read_tum_trajectory_file(str(export("tum")))
    kitti = file_interface.read_kitti_poses_file(str(export("kitti").absolute()))
    track = run.read_trajectory()
    assert np.allclose(tum.poses_se3, track.T_world_camera, atol=1e-6)
    assert np.allclose(kitti.poses_se3, track.T_world_camera, atol=1e-6)


def _with_gap(run, root):
    """Copy a run, and take the poses of frames 4, 5 and 9 out of it."""
    shutil.copytree(run.root, root)
    folder = RunFolder(root)
    lines = folder.trajectory.read_text().splitlines(keepends=True)
    kept = [line for i, line in enumerate(lines) if i - 1 not in (4, 5, 9)]
    folder.trajectory.write_text("".join(kept))
    return folder


def test_kitti_says_which_frames_have_no_pose(run, tmp_path, monkeypatch, capsys):
    folder = _with_gap(run, tmp_path / "run")
    path = tmp_path / "poses.txt"
    assert roomgraph(monkeypatch, "export", folder.root, "kitti", "-o", path) == 0
    said = capsys.readouterr().out
    assert "3 of 60 frames have no pose and no line: 4-5, 9;" in said
    with (tmp_path / "poses_frames.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [row["line"] for row in rows[3:11]] == ["3", "", "", "4", "5", "6", "", "7"]
    kitti, tum = read_kitti(path), read_tum(folder.trajectory)
    for row in rows:
        if row["line"]:
            line = int(row["line"])
            assert tum.stamps_s[line] == pytest.approx(float(row["timestamp"]), abs=1e-6)
            assert np.allclose(kitti.T_world_camera[line], tum.T_world_camera[line], atol=1e-6)


def test_the_table_has_every_frame(run, tmp_path, monkeypatch):
    import pandas

    folder, path = _with_gap(run, tmp_path / "run"), tmp_path / "path.csv"
    assert roomgraph(monkeypatch, "export", folder.root, "csv", "-o", path, "--quiet") == 0
    table = pandas.read_csv(path)
    assert len(table) == 60
    assert np.flatnonzero(table.tx.isna()).tolist() == [4, 5, 9]
    known = table.dropna()
    positions = folder.read_trajectory().positions
    assert np.allclose(known[["tx", "ty", "tz"]].to_numpy(), positions, atol=1e-8)


def test_pose_graph_in_gtsam(run, export):
    import gtsam

    factors, values = gtsam.readG2o(str(export("g2o")), True)
    assert values.size() == run.read_metrics()["keyframes"]
    keys = values.keys()
    poses_read = np.array([values.atPose3(key).matrix() for key in keys])
    assert np.allclose(poses_read, read_tum(run.keyframes).T_world_camera, atol=1e-4)
    assert factors.size() >= values.size() - 1


@pytest.mark.parametrize("name", ["ply", "pcd"])
def test_clouds_in_open3d(run, export, name):
    import open3d as o3d

    cloud = o3d.t.io.read_point_cloud(str(export(name)))
    original = o3d.t.io.read_point_cloud(str(run.map))
    for attribute in original.point:
        ours, theirs = original.point[attribute].numpy(), cloud.point[attribute].numpy()
        assert np.allclose(ours, theirs), attribute
    assert "label" in cloud.point


def _upright(run):
    """Return the map's points in the map frame, z up, with their colours and labels."""
    import open3d as o3d

    cloud = o3d.t.io.read_point_cloud(str(run.map))
    points = se3.transform(read_occupancy(run.occupancy).T_map_world, cloud.point.positions.numpy())
    return points, cloud.point.colors.numpy(), cloud.point["label"].numpy()[:, 0]


def test_las_in_laspy(run, export):
    import laspy

    cloud = laspy.read(export("las"))
    points, colours, label_ids = _upright(run)
    assert np.allclose(cloud.xyz, points, atol=2e-4)
    assert np.array_equal(np.asarray(cloud.red) // 257, colours[:, 0])
    assert np.array_equal(np.asarray(cloud["label"]), label_ids)


def test_e57_in_pye57(run, export):
    import pye57

    file = pye57.E57(str(export("e57")))
    scan = file.read_scan(0, ignore_missing_fields=True, colors=True, intensity=True)
    file.close()
    points, colours, label_ids = _upright(run)
    got = np.column_stack([scan[f"cartesian{axis}"] for axis in "XYZ"])
    assert np.allclose(got, points, atol=1e-4)
    assert np.array_equal(scan["colorGreen"], colours[:, 1])
    assert np.array_equal(scan["intensity"], label_ids)


@pytest.mark.parametrize("name", ["mesh-ply", "obj", "glb"])
def test_meshes_in_trimesh(run, export, name):
    import trimesh
    from scipy.spatial import cKDTree

    (mesh,) = trimesh.load_scene(export(name), process=False).geometry.values()
    points, colours, _ = read_cloud(run.map)
    if name != "mesh-ply":
        x, y, z = _upright(run)[0].T
        points = np.column_stack([x, z, -y])
    gaps, nearest = cKDTree(points).query(mesh.vertices)
    assert len(mesh.faces) > 0.5 * len(points)
    assert np.percentile(gaps, 95) < 0.05
    near = gaps < 0.01
    if name == "glb":
        seen = np.asarray(mesh.visual.vertex_attributes["color"])[:, :3] / 255
        seen = np.where(seen <= 0.0031308, 12.92 * seen, 1.055 * seen ** (1 / 2.4) - 0.055)
    else:
        seen = np.asarray(mesh.visual.vertex_colors)[:, :3] / 255
    assert np.median(np.abs(seen - colours[nearest] / 255)[near]) < 0.05
    if name != "mesh-ply":
        floor = (np.abs(mesh.vertices[:, 1]) < 0.02) & near
        assert np.median(mesh.vertex_normals[floor, 1]) > 0.9


def test_a_glb_is_matt(export):
    data = export("glb").read_bytes()
    (length,) = struct.unpack("<I", data[12:16])
    tree = json.loads(data[20 : 20 + length])
    assert tree["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] == 0
    assert tree["meshes"][0]["primitives"][0]["material"] == 0


# pydot calls pyparsing by its old names.
@pytest.mark.filterwarnings("ignore:.*deprecated - use:DeprecationWarning")
def test_graphs_in_networkx_and_pydot(run, export):
    import pydot

    graph = read_graph_json(run.graph_json)
    edges = {(e.source, e.target) for e in graph.edges}
    node_link = networkx.node_link_graph(json.loads(export("json").read_text()))
    graphml = networkx.read_graphml(export("graphml"), node_type=int)
    (dot,) = pydot.graph_from_dot_file(str(export("dot")))
    assert {tuple(sorted(e)) for e in node_link.edges} == edges
    assert {tuple(sorted(e)) for e in graphml.edges} == edges
    assert {(int(e.get_source()), int(e.get_destination())) for e in dot.get_edges()} == edges
    for node in graph.nodes:
        linked, drawn = node_link.nodes[node.id], graphml.nodes[node.id]
        assert (linked["label"], linked["place"]) == (node.label, node.place)
        assert (drawn["label"], drawn["place"]) == (node.label, node.place)
        assert np.allclose(linked["position"], node.position_world, atol=1e-6)
        assert np.allclose([drawn[axis] for axis in "xyz"], node.position_world, atol=1e-6)
    lengths = {(e.source, e.target): e.length_m for e in graph.edges}
    for a, b, values in graphml.edges(data=True):
        assert values["length"] == pytest.approx(lengths[min(a, b), max(a, b)], abs=1e-6)
    named = {int(n.get_name()): n.get_label().strip('"') for n in dot.get_nodes() if n.get_label()}
    assert named == {node.id: node.place for node in graph.nodes}


def test_graph_tables_in_pandas(run, export):
    import pandas

    path = export("graph-csv")
    nodes, edges = pandas.read_csv(path), pandas.read_csv(path.with_name("product_edges.csv"))
    graph = read_graph_json(run.graph_json)
    assert np.allclose(nodes[["x", "y", "z"]].to_numpy(), graph.positions, atol=1e-6)
    assert nodes.place.tolist() == [node.place for node in graph.nodes]
    assert edges.source.tolist() == [edge.source for edge in graph.edges]


def test_hydra_in_spark_dsg(run, export):
    dsg = pytest.importorskip("spark_dsg")
    scene = dsg.DynamicSceneGraph.load(str(export("hydra")))
    graph = read_graph_json(run.graph_json)
    places = list(scene.get_layer(dsg.DsgLayers.PLACES).nodes)
    rooms = {n.attributes.name: n for n in scene.get_layer(dsg.DsgLayers.ROOMS).nodes}
    assert len(places) == len(graph.nodes)
    assert set(rooms) == set(graph.places)
    assert scene.get_layer(dsg.DsgLayers.PLACES).num_edges() == len(graph.edges)
    T = read_occupancy(run.occupancy).T_map_world
    for node in graph.nodes:
        place = scene.get_node(dsg.NodeSymbol("p", node.id).value)
        assert np.allclose(
            place.attributes.position, se3.transform(T, node.position_world[None])[0]
        )
        assert place.get_parent() == rooms[node.place].id.value
        assert place.attributes.semantic_label == node.label_id
    assert all(0.5 < place.attributes.position[2] < 1.1 for place in places)


def test_occupancy_grid_in_pillow_and_yaml(run, export):
    import yaml
    from PIL import Image

    path = export("nav2")
    content = yaml.safe_load(path.read_text())
    assert content["mode"] == "trinary"
    image = np.array(Image.open(path.parent / content["image"]))
    assert set(np.unique(image)) <= {0, 205, 254}
    # Where the camera went nothing stands, seen as map_server sees it: rows from the bottom up.
    T = np.array(content["T_map_world"])
    xy = se3.transform(T, run.read_trajectory().positions)[:, :2]
    columns, rows = ((xy - content["origin"][:2]) / content["resolution"]).astype(int).T
    way = image[image.shape[0] - 1 - rows, columns]
    assert np.all(way != 0)
    assert np.mean(way == 254) > 0.5


def test_what_cannot_be_exported(run, tmp_path, monkeypatch, capsys):
    def said(*arguments):
        assert roomgraph(monkeypatch, "export", *arguments) == 1
        error = capsys.readouterr().err
        assert error.count("\n") == 1
        return error

    assert "graph-csv" in said(run.root, "docx")
    (tmp_path / "empty").mkdir()
    assert "has no such output" in said(tmp_path / "empty", "ply")
    assert "not the folder of a finished run" in said(tmp_path / "empty", "kitti")
    assert "no such folder" in said(run.root, "ply", "-o", tmp_path / "nowhere" / "map.ply")
    assert "NAME.pcd" in said(run.root, "pcd", "-o", tmp_path / "map.xyz")
    assert "NAME.yaml" in said(run.root, "nav2", "-o", tmp_path / "map.png")
