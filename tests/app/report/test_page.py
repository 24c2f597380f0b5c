"""The report and the floor plan of a run, as files that a browser opens without a network."""

import io
import json
import re
import shutil
import xml.etree.ElementTree as ET
from dataclasses import replace
from html.parser import HTMLParser

import cv2
import numpy as np
import pytest
from rich.console import Console

from roomgraph.app.answers.explanations import place_reasons
from roomgraph.app.errors import AppError
from roomgraph.app.report.figures import summary
from roomgraph.app.report.page import write_report
from roomgraph.app.report.summary import found_words
from roomgraph.app.storage.run_folder import RunFolder
from roomgraph.app.storage.thumbnails import ThumbnailWriter, read_thumbnails
from roomgraph.semantics.graph.files import read_graph_json
from roomgraph.semantics.graph.graph import Doorway, RoomPolygon, SemanticGraph
from roomgraph.semantics.labels import LabelSpace
from roomgraph.semantics.rooms.doorway_lines import doorway_ends
from tests.app.command import roomgraph


class _Page(HTMLParser):
    """Collects what a page links to, what it says, and whether its elements are closed."""

    EMPTY = ("meta", "img", "br", "link", "input", "use", "path", "rect")

    def __init__(self):
        super().__init__()
        self.links, self.words, self.open = [], [], []

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.links += [values[n] for n in ("src", "href", "xlink:href") if values.get(n)]
        if tag not in self.EMPTY:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if tag not in self.EMPTY:
            assert self.open.pop() == tag

    def handle_startendtag(self, tag, attributes):
        self.links += [v for n, v in attributes if n in ("src", "href", "xlink:href")]

    def handle_data(self, data):
        self.words.append(data)


def page_of(run):
    page = _Page()
    page.feed((run / "report.html").read_text())
    assert page.open == []
    return page


def test_the_page_needs_no_other_file(mapped):
    page = page_of(mapped[1])
    assert len(page.links) > 3
    assert all(link.startswith(("data:image/", "#")) for link in page.links)
    styles = re.findall(r"url\((.*?)\)", (mapped[1] / "report.html").read_text())
    assert all(style.startswith("#") for style in styles)


def test_the_page_says_what_was_found(mapped):
    run = mapped[1]
    text = " ".join(page_of(run).words)
    graph, metrics = read_graph_json(run / "graph.json"), RunFolder(run).read_metrics()
    for room in graph.rooms:
        assert room.name in text
        assert f"{room.area_m2:.1f} m²" in text
    assert f"(ATE): {metrics['ate_rmse_m'] * 100:.2f} cm RMSE" in text
    assert "Trajectory compared with the ground truth" in text
    assert "A rendered building: errors are measured against its true path and rooms" in text
    assert "Labels over time" in text
    assert "Why these labels" in text
    for reason in place_reasons(graph):
        assert reason["chances"] in text
        assert reason["frames"] in text
    assert "[slam.features]" in text
    assert f"A walk of {metrics['path_length_m']:.0f} m through " in text


def test_what_was_found_is_a_sentence():
    labels = LabelSpace.of(["office", "elevator_area"])
    square = np.array([[0.0, 0], [1, 0], [1, 1]])
    rooms = tuple(
        RoomPolygon(f"{label}{i}", label, 0, 0.9, square, 1.0, square[0])
        for i, label in enumerate(["office", "elevator_area", "office", "unknown"])
    )
    door = Doorway(("a", "b"), np.zeros(2), None)
    graph = SemanticGraph(labels, (), (), rooms, (door, door))
    assert found_words(graph, {"path_length_m": 12.4}) == (
        "A walk of 12 m through 2 offices, an elevator area, a room without a label, "
        "joined by 2 doorways."
    )
    assert found_words(replace(graph, rooms=()), {"path_length_m": 1.0}) == ""


def test_doors_lie_in_their_walls():
    c, s = np.cos(0.4), np.sin(0.4)
    turn = np.array([[c, s], [-s, c]])
    square = np.array([[0.0, 0], [3, 0], [3, 4], [0, 4]])
    rooms = tuple(
        RoomPolygon(name, name, 0, 1.0, outline @ turn, 12.0, np.zeros(2))
        for name, outline in (("a", square), ("b", square + np.array([3.0, 0])), ("c", square * 9))
    )
    for at, along in (((3.0, 2.0), (0.0, 1.0)), ((1.5, 0.0), (1.0, 0.0))):
        door = Doorway(("a", "b"), np.array(at) @ turn, 0.9)
        ends = doorway_ends(SemanticGraph(LabelSpace(), (), (), rooms, (door,)), door)
        assert np.allclose(ends.mean(axis=0), door.position_map)
        way = (ends[1] - ends[0]) @ turn.T
        assert np.linalg.norm(way) == pytest.approx(0.9)
        assert abs(way @ along) == pytest.approx(0.9, abs=0.01)


def test_the_floor_plan_is_a_picture_and_a_drawing(mapped):
    run = mapped[1]
    image = cv2.imread(str(run / "floorplan.png"))
    assert image.shape[1] == 1100
    assert len(np.unique(image.reshape(-1, 3), axis=0)) > 20
    root = ET.parse(run / "floorplan.svg").getroot()
    words = " ".join(element.text or "" for element in root.iter() if element.tag.endswith("text"))
    for room in read_graph_json(run / "graph.json").rooms:
        assert room.name.replace("_", " ") in words
    assert " m" in words


def test_the_same_run_gives_the_same_drawing(mapped, tmp_path):
    copy = tmp_path / "run"
    shutil.copytree(mapped[1], copy)
    write_report(RunFolder(copy))
    for name in ("floorplan.svg", "floorplan.png"):
        assert (copy / name).read_bytes() == (mapped[1] / name).read_bytes(), name


def test_names_and_warnings_are_only_text(mapped, tmp_path):
    copy = tmp_path / "run"
    shutil.copytree(mapped[1], copy)
    text = (copy / "metrics.json").read_text()
    text = text.replace('"warnings": []', '"warnings": ["<script>alert(1)</script> & so"]')
    (copy / "metrics.json").write_text(text)
    write_report(RunFolder(copy))
    assert "<script" not in (copy / "report.html").read_text()
    assert any("<script>alert(1)</script> & so" in words for words in page_of(copy).words)


def test_without_the_sequence_the_report_leaves_the_truth_out(mapped, tmp_path):
    copy = tmp_path / "run"
    shutil.copytree(mapped[1], copy)
    (copy / "input.toml").write_text(f'sequence = "{tmp_path / "gone"}"\n')
    write_report(RunFolder(copy))
    assert "Trajectory compared with the ground truth" not in " ".join(page_of(copy).words)


def test_no_report_leaves_it_out(rendered_walk, tmp_path, monkeypatch):
    out = tmp_path / "out"
    flags = ("--no-rrd", "--no-report", "--quiet", "--frames", "4")
    assert roomgraph(monkeypatch, "run", rendered_walk, "-o", out, *flags) == 0
    assert not (out / "report.html").exists() and not (out / "floorplan.png").exists()


def test_the_report_command_makes_it_again(mapped, tmp_path, monkeypatch, capsys):
    copy = tmp_path / "run"
    shutil.copytree(mapped[1], copy)
    (copy / "report.html").unlink()
    config = (copy / "config.toml").read_text()
    (copy / "config.toml").write_text(config.replace("seed = 0", "seed = 7\nfrom_a_newer = 1"))
    assert roomgraph(monkeypatch, "report", copy) == 0
    assert str(copy / "report.html") in capsys.readouterr().out
    text = " ".join(page_of(copy).words)
    assert "from_a_newer" in text and "Changed from the defaults" in text
    assert roomgraph(monkeypatch, "report", tmp_path) == 1
    assert capsys.readouterr().err.startswith("roomgraph: ")


def test_thumbnails_come_back(tmp_path, rng):
    path = tmp_path / "thumbnails.zip"
    writer = ThumbnailWriter(path)
    writer.add(3, rng.integers(0, 255, (48, 64, 3)).astype(np.uint8))
    writer.add(11, np.zeros((48, 64, 3), np.uint8))
    writer.close()
    pictures = read_thumbnails(path)
    assert sorted(pictures) == [3, 11]
    assert cv2.imdecode(np.frombuffer(pictures[11], np.uint8), 1).shape == (144, 192, 3)
    assert read_thumbnails(tmp_path / "none.zip") == {}
    path.write_bytes(path.read_bytes()[:100])
    with pytest.raises(AppError, match="thumbnails"):
        read_thumbnails(path)


def _summary_words(metrics):
    console = Console(width=200, file=io.StringIO())
    console.print(summary(metrics))
    return console.file.getvalue()


def test_places_without_labels_are_told_why(mapped):
    metrics = RunFolder(mapped[1]).read_metrics()
    assert "corridor1" in _summary_words(metrics)
    unnamed = metrics | {"places": ["room1", "room2"]}
    known = ", ".join(metrics["labels"])
    assert f"2, none recognised by the model, which knows {known}" in _summary_words(unnamed)
    assert "2, not labelled (no place model given" in _summary_words(unnamed | {"labels": []})
    assert "not labelled (no place model given" in _summary_words(
        unnamed | {"labels": [], "places": []}
    )


def test_a_model_that_knows_no_place_is_a_warning(mapped, tmp_path):
    copy = tmp_path / "run"
    shutil.copytree(mapped[1], copy)
    content = json.loads((copy / "graph.json").read_text())
    for node in content["nodes"]:
        node |= {"label": "unknown", "label_id": 0}
    (copy / "graph.json").write_text(json.dumps(content))
    write_report(RunFolder(copy))
    assert any(
        "no place was recognised by the model, which knows" in words
        for words in page_of(copy).words
    )
