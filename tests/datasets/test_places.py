import numpy as np
import pytest

from roomgraph.datasets.errors import DatasetError
from roomgraph.datasets.places import PlaceTruth, read_places, write_places


def test_round_trip(tmp_path):
    places = PlaceTruth(np.array([1.0, 2.5]), ("office", "corridor"), ("office1", ""))
    write_places(tmp_path / "places.csv", places)
    back = read_places(tmp_path / "places.csv")
    assert back.labels == places.labels
    assert back.instances == places.instances
    assert np.allclose(back.stamps_s, places.stamps_s)


def test_floors_and_transitions_come_back_in_the_order_of_time(tmp_path):
    places = PlaceTruth(
        np.array([2.0, 1.0]), ("stairwell", "hall"), ("stairs1", "hall1"), (1, 0), ("stairs", "")
    )
    write_places(tmp_path / "places.csv", places)
    lines = (tmp_path / "places.csv").read_text().splitlines()
    assert lines[0] == "timestamp,label,instance,floor,transition"
    back = read_places(tmp_path / "places.csv")
    assert back.labels == ("hall", "stairwell")
    assert back.floors == (0, 1)
    assert back.transitions == ("", "stairs")
    assert back.at(1.02) == ("hall", "hall1")
    assert back.at(1.5) is None


def test_what_the_file_does_not_say_is_empty(tmp_path):
    path = tmp_path / "places.csv"
    write_places(path, PlaceTruth(np.array([1.0]), ("office",), ("office1",)))
    assert path.read_text().splitlines()[0] == "timestamp,label,instance"
    back = read_places(path)
    assert (back.floors, back.transitions) == ((), ())
    path.write_text("timestamp,label,floor\n1,office,2\n")
    assert read_places(path).floors == (2,)
    assert read_places(path).instances == ("",)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a,b\n1,2\n", "header"),
        ("timestamp,label\n", "no place labels"),
        ("timestamp,label\nsoon,office\n", "not a number"),
        ("timestamp,label,floor\n1,office,up\n", "not a whole number"),
        ("timestamp,label,floor\n1,office\n", "not a whole number"),
    ],
)
def test_bad_files_are_named(tmp_path, text, message):
    (tmp_path / "places.csv").write_text(text)
    with pytest.raises(DatasetError, match=message):
        read_places(tmp_path / "places.csv")
