import numpy as np
import pytest

from roomgraph.semantics.errors import SemanticsError
from roomgraph.semantics.labels import ROOM_COLOURS, LabelSpace, read_labels, write_labels


def test_unknown_comes_first_and_names_are_sorted():
    labels = LabelSpace.of(["office", "corridor", "unknown", "office"])
    assert labels.names == ("unknown", "corridor", "office")
    assert labels.id_of("unknown") == 0
    assert labels.id_of("office") == 2
    assert labels.colours[0] == (128, 128, 128)


def test_rooms_have_their_colour_and_all_colours_differ():
    names = [*ROOM_COLOURS, "Living Room", "sauna", "cinema", "garage", "crypt"]
    labels = LabelSpace.of(names)
    assert labels.colours[labels.id_of("office")] == ROOM_COLOURS["office"]
    apart = np.linalg.norm(labels.palette[:, None].astype(float) - labels.palette, axis=2)
    assert apart[~np.eye(len(labels), dtype=bool)].min() > 20


def test_colours_do_not_depend_on_the_order_given():
    assert LabelSpace.of(["sauna", "office"]) == LabelSpace.of(["office", "sauna"])


def test_palette_has_a_row_for_each_id():
    labels = LabelSpace.of(["office"])
    assert labels.palette.shape == (2, 3)
    assert labels.palette.dtype == np.uint8


def test_round_trip(tmp_path):
    labels = LabelSpace.of(["kitchen", "büro", "corridor"])
    write_labels(tmp_path / "labels.json", labels)
    assert read_labels(tmp_path / "labels.json") == labels


@pytest.mark.parametrize("names", [(), ("office",), ("unknown", "a", "a")])
def test_refuses_what_is_no_label_space(names):
    with pytest.raises(SemanticsError, match="not a label space"):
        LabelSpace(names, ((0, 0, 0),) * len(names))


def test_unknown_name_is_told():
    with pytest.raises(SemanticsError, match="got 'cellar'"):
        LabelSpace.of(["office"]).id_of("cellar")


@pytest.mark.parametrize(
    "text",
    [
        "{",
        "[]",
        '{"schema": "roomgraph/labels", "version": 2}',
        '{"schema": "roomgraph/labels", "version": 1}',
        '{"schema": "roomgraph/labels", "version": 1, "labels": [{"id": 0}]}',
        '{"schema": "roomgraph/labels", "version": 1, "labels": '
        '[{"id": 3, "name": "unknown", "colour": [1, 2, 3]}]}',
    ],
)
def test_reader_refuses_other_files(tmp_path, text):
    path = tmp_path / "labels.json"
    path.write_text(text)
    with pytest.raises(SemanticsError, match=r"labels\.json"):
        read_labels(path)


def test_reader_names_a_missing_file(tmp_path):
    with pytest.raises(SemanticsError, match=r"none\.json"):
        read_labels(tmp_path / "none.json")
