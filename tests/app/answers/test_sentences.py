"""Questions to a map, as a user asks them."""

import json
import shutil
import sys

import cv2
import numpy as np
import pytest

from roomgraph.app.storage.run_folder import RunFolder
from roomgraph.datasets import se3
from roomgraph.datasets.readers.registry import open_sequence
from roomgraph.semantics.graph.files import read_graph_json
from tests.app.command import roomgraph


@pytest.fixture
def ask(mapped, monkeypatch, capsys):
    """Ask the run something; return what is said."""

    def question(command, *arguments, status=0):
        capsys.readouterr()
        assert roomgraph(monkeypatch, command, mapped[1], *arguments) == status
        said = capsys.readouterr()
        return said.err if status else said.out

    return question


def test_places_are_told(ask, mapped):
    graph = read_graph_json(RunFolder(mapped[1]).graph_json)
    told = json.loads(ask("places", "--json"))
    assert [row["place"] for row in told] == list(graph.places)
    assert sorted(node for row in told for node in row["nodes"]) == [n.id for n in graph.nodes]
    table = ask("places")
    assert all(name in table for name in graph.places)


def test_a_route_is_told(ask, mapped):
    graph = read_graph_json(RunFolder(mapped[1]).graph_json)
    first, last = graph.nodes[0], graph.nodes[-1]
    ends = [",".join(f"{v:.3f}" for v in node.position_world) for node in (first, last)]
    told = json.loads(ask("route", *ends, "--json"))
    assert (told["nodes"][0], told["nodes"][-1]) == (first.id, last.id)
    straight = np.linalg.norm(first.position_world - last.position_world)
    walked = sum(edge.length_m for edge in graph.edges)
    assert straight - 1e-6 <= told["length_m"] <= walked + 1e-3
    text = ask("route", *ends)
    assert f"{told['length_m']:.1f} m" in text
    assert text.count("\n") == (len(told["legs"]) + 1 if len(told["legs"]) > 1 else 1)


def test_a_route_to_nowhere_is_refused(ask):
    said = ask("route", "attic", "office", status=1)
    assert said.startswith("roomgraph: no such place: attic")
    assert said.count("\n") == 1


def _error(run, row, truth, index):
    """Return how far, in metres and degrees, an answer's pose is from the true one."""
    T_run_truth = se3.inverse(truth.T_world_camera[0])
    difference = se3.inverse(T_run_truth @ truth.T_world_camera[index]) @ np.array(
        row["T_world_camera"]
    )
    return np.linalg.norm(difference[:3, 3]), np.degrees(se3.rotation_angle(difference))


@pytest.mark.parametrize("with_depth", [True, False])
def test_an_image_is_located(ask, mapped, rendered_walk, with_depth):
    walk = open_sequence(rendered_walk)
    index = 37
    images = [walk.colour_files[index], *([walk.depth_files[index]] if with_depth else [])]
    (row,) = json.loads(ask("locate", *images, "--json"))
    metres, degrees = _error(mapped[1], row, walk.ground_truth, index)
    assert metres < 0.1
    assert degrees < 3
    graph = read_graph_json(RunFolder(mapped[1]).graph_json)
    distances = np.linalg.norm(graph.positions - np.array(row["T_world_camera"])[:3, 3], axis=1)
    assert row["node"] == distances.argmin()
    assert row["place"] in graph.places
    assert 0.5 < row["sureness"] <= 1
    sentence = ask("locate", *images)
    assert f"{row['sureness']:.0%} sure" in sentence
    assert f"nearest node {row['node']}" in sentence


def test_an_image_of_half_the_size_is_located(ask, mapped, rendered_walk, tmp_path):
    walk = open_sequence(rendered_walk)
    image = cv2.imread(str(walk.colour_files[20]))
    small = cv2.resize(image, None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA)
    cv2.imwrite(str(tmp_path / "small.png"), small)
    (row,) = json.loads(ask("locate", tmp_path / "small.png", "--json"))
    metres, _ = _error(mapped[1], row, walk.ground_truth, 20)
    assert metres < 0.1


def test_a_walk_is_followed(ask, rendered_walk):
    told = ask("locate", rendered_walk, "--stride", "5").splitlines()
    assert "s: you are in" in told[0]
    assert told[-1] == "12 frames: place found for 12, pose found for 12"


def test_a_folder_of_images_is_located_by_name(ask, rendered_walk):
    told = ask("locate", rendered_walk / "rgb", "--frames", "3").splitlines()
    assert len(told) == 3
    assert all("You are in" in line for line in told)


def test_an_image_of_nothing_is_not_located(ask, tmp_path):
    cv2.imwrite(str(tmp_path / "grey.png"), np.full((240, 320, 3), 127, np.uint8))
    assert "Place not recognised." in ask("locate", tmp_path / "grey.png")


def test_speaking_without_a_voice_still_answers(ask, rendered_walk, tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("PATH", str(tmp_path))
    image = open_sequence(rendered_walk).colour_files[0]
    assert "You are in" in ask("locate", image, "--speak")


def test_what_cannot_be_located_is_said(ask, rendered_walk, mapped, tmp_path, monkeypatch, capsys):
    walk = open_sequence(rendered_walk)
    assert "nowhere.png" in ask("locate", tmp_path / "nowhere.png", status=1)
    cv2.imwrite(str(tmp_path / "wide.png"), np.zeros((100, 320, 3), np.uint8))
    assert "--camera" in ask("locate", tmp_path / "wide.png", status=1)
    (tmp_path / "empty").mkdir()
    assert "nothing to locate" in ask("locate", tmp_path / "empty", status=1)
    both = (walk.root / "rgb", walk.depth_files[0])
    assert "nothing to locate" in ask("locate", *both, status=1)
    assert "not a depth image" in ask(
        "locate", walk.colour_files[0], walk.colour_files[0], status=1
    )
    old = tmp_path / "old"
    shutil.copytree(mapped[1], old)
    (old / "keyframes.npz").unlink()
    monkeypatch.setattr(sys, "argv", ["roomgraph"])
    assert roomgraph(monkeypatch, "locate", old, walk.colour_files[0]) == 1
    assert "keyframes.npz" in capsys.readouterr().err
