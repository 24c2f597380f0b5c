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


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a,b\n1,2\n", "header"),
        ("timestamp,label\n", "no place labels"),
        ("timestamp,label\nsoon,office\n", "not a number"),
    ],
)
def test_bad_files_are_named(tmp_path, text, message):
    (tmp_path / "places.csv").write_text(text)
    with pytest.raises(DatasetError, match=message):
        read_places(tmp_path / "places.csv")
