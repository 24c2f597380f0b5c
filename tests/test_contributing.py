"""The worked example of CONTRIBUTING: a descriptor in one file and one line of a registry."""

import csv
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
TEXT = (ROOT / ".github" / "CONTRIBUTING.md").read_text(encoding="utf-8")
SECTION = TEXT[TEXT.index("## Add a descriptor") :]
FLOORS = ("app", "datasets", "semantics", "slam")


@pytest.fixture(scope="module")
def extended(tmp_path_factory) -> Path:
    """A copy of the program to which the example was added as it is written."""
    root = tmp_path_factory.mktemp("extended")
    for floor in FLOORS:
        shutil.copytree(ROOT / floor, root / floor, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copytree(ROOT / ".typing", root / ".typing", symlinks=True)
    file, line = re.findall(r"```(?:python|text)\n(.*?)```", SECTION, re.DOTALL)[:2]
    folder = root / "semantics" / "descriptors"
    (folder / "mean_colour.py").write_text(file)
    registry = folder / "registry.py"
    last = '    "fisher.FisherDescriptor",\n'
    assert last in registry.read_text()
    registry.write_text(registry.read_text().replace(last, last + line))
    return root


def command(root: Path, *arguments: object) -> str:
    """Run the copy's command; return what it said."""
    code = "from roomgraph.app.cli.main import main; main()"
    done = subprocess.run(
        [sys.executable, "-c", code, *map(str, arguments)], cwd=root, text=True,
        capture_output=True, check=False, env={**os.environ, "PYTHONPATH": str(root / ".typing")},
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.slow
def test_train_run_and_eval_use_a_descriptor_of_one_file_and_one_line(
    extended, rendered_walk, tmp_path
):
    assert "[semantics.training.descriptors.mean_colour]" in command(extended, "config")
    model, run = tmp_path / "model", tmp_path / "run"
    command(extended, "train", rendered_walk, "-o", model, "--descriptor", "mean_colour")
    assert json.loads((model / "model.json").read_text())["descriptor"]["name"] == "mean_colour"
    command(extended, "run", rendered_walk, "-o", run, "--model", model, "--no-rrd", "--no-report")
    with (run / "frames.csv").open() as file:
        labels = [row["label"] for row in csv.DictReader(file)]
    assert len(set(labels)) > 1
    assert "correct labels" in command(extended, "eval", run)
    arguments = ("--data", rendered_walk, "--descriptor", "mean_colour", "-o", tmp_path)
    command(extended, "eval", "--protocol", "recognition", *arguments)
    content = json.loads((tmp_path / "recognition.json").read_text())
    assert content["recipe"] == "mean_colour, linear_svm"
    assert content["accuracy_mean"] > 1 / 3
