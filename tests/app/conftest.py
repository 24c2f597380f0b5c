"""A run that many tests of the application look at."""

import pytest

from tests.app.command import roomgraph


@pytest.fixture(scope="session")
def mapped(rendered_walk, tmp_path_factory):
    """Folders of a place model and of a run with it, on the rendered walk."""
    root = tmp_path_factory.mktemp("mapped")
    with pytest.MonkeyPatch.context() as patch:
        model = root / "model"
        status = roomgraph(patch, "train", rendered_walk, "-o", model, "--quiet")
        assert status == 0
        arguments = ("run", rendered_walk, "-o", root / "run", "--model", model, "--quiet")
        assert roomgraph(patch, *arguments) == 0
    return model, root / "run"
