"""The program in the README runs as it stands."""

import re
from pathlib import Path

import pytest

import roomgraph

ROOT = Path(__file__).parent.parent.parent


@pytest.mark.slow
def test_the_program_of_the_readme(rendered_walk, mapped, tmp_path, monkeypatch, capsys):
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    (program,) = re.findall(r"<!-- python -->\n```python\n(.*?)```", text, re.DOTALL)
    model, run = mapped
    for name, target in (("walk", rendered_walk), ("places", model), ("out", run)):
        (tmp_path / name).symlink_to(target)
    monkeypatch.chdir(tmp_path)
    exec(compile(program, "README.md", "exec"), {})
    said = capsys.readouterr().out.splitlines()
    assert re.match(r"\d+ keyframes; last frame ok: \[\[", said[0])
    assert said[-2] in ("corridor", "elevator_area", "office")
    assert re.match(r"\('\w+', .*\) \d+\.\d+ \w+", said[-1])


def test_an_image_of_another_shape_is_refused(mapped, rendered_walk):
    run = roomgraph.open_run(mapped[1])
    colour = roomgraph.open_sequence(rendered_walk)[0].colour
    with pytest.raises(roomgraph.RoomgraphError, match="aspect ratio"):
        run.locate(colour[:, :200])
    with pytest.raises(roomgraph.RoomgraphError, match="not a colour image"):
        run.locate(colour[:, :, 0])


def test_completion_leads_to_the_floors():
    assert {"app", "datasets", "semantics", "slam", "Slam", "open_run"} <= set(dir(roomgraph))
    assert roomgraph.slam.Slam is roomgraph.Slam


def test_every_public_name_is_there():
    for floor in ("", ".app", ".slam", ".semantics", ".datasets"):
        module = __import__(f"roomgraph{floor}", fromlist=["*"])
        assert module.__all__
        for name in module.__all__:
            assert getattr(module, name).__doc__, name
    assert roomgraph.__version__
