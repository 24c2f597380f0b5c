"""The house in order: folders, packages and links agree with each other."""

import ast
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
FLOORS = ("app", "datasets", "semantics", "slam")
MOST_FILES, FEWEST_FILES = 15, 4
# Not packages of a floor: the root package's own folder, and the documentation.
NO_PACKAGES = {ROOT / "app/_root", ROOT / "app/docs"}


def _folders_of_code(*tops):
    """Return the folders that hold Python files, or that folders with such files lie in."""
    holders = {file.parent for top in tops for file in (ROOT / top).rglob("*.py")}
    between = {up for folder in holders for up in folder.parents if ROOT in up.parents}
    return sorted((holders | between) - NO_PACKAGES)


def _name(folder):
    return folder.relative_to(ROOT).as_posix()


PACKAGES = [_name(folder) for folder in _folders_of_code(*FLOORS)]
FOLDERS = PACKAGES + [_name(folder) for folder in _folders_of_code("tests")]


def test_the_installed_packages_are_the_folders_of_code():
    setuptools = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["setuptools"]
    listed = setuptools["packages"]
    there = {"roomgraph", *("roomgraph." + name.replace("/", ".") for name in PACKAGES)}
    assert sorted(there - set(listed)) == [], "folders that pyproject.toml does not list"
    assert sorted(set(listed) - there) == [], "listed in pyproject.toml, but no folder of code"
    assert len(listed) == len(set(listed)), "listed twice in pyproject.toml"
    mapped = {"roomgraph": "app/_root", **{f"roomgraph.{floor}": floor for floor in FLOORS}}
    assert setuptools["package-dir"] == mapped


@pytest.mark.parametrize("name", FOLDERS)
def test_a_folder_is_a_package_that_is_neither_crowded_nor_nearly_empty(name):
    files = [file.name for file in (ROOT / name).glob("*.py")]
    assert "__init__.py" in files, f"{name}/ has no __init__.py"
    fewest = FEWEST_FILES if name in PACKAGES else 1
    told = f"{name}/ holds {len(files)} Python files, not {fewest} to {MOST_FILES}"
    assert fewest <= len(files) <= MOST_FILES, told


@pytest.mark.parametrize("name", PACKAGES)
def test_a_package_says_in_one_line_what_it_is_for(name):
    source = (ROOT / name / "__init__.py").read_text(encoding="utf-8")
    told = ast.get_docstring(ast.parse(source), clean=False)
    assert told, f"{name}/__init__.py has no docstring"
    assert len(told.splitlines()) == 1, f"the docstring of {name}/__init__.py is not one line"
    assert told.endswith("."), f"the docstring of {name}/__init__.py is no sentence"


def test_the_links_for_typing_lead_to_the_folders():
    inside = (ROOT / ".typing/roomgraph").iterdir()
    links = {link.name: link for link in inside if link.name != "__pycache__"}
    expected = {floor: ROOT / floor for floor in FLOORS}
    expected |= {file.name: file for file in (ROOT / "app/_root").iterdir() if file.is_file()}
    assert sorted(links) == sorted(expected)
    for name, link in links.items():
        assert link.is_symlink(), f".typing/roomgraph/{name} is no link"
        assert link.resolve() == expected[name].resolve(), f".typing/roomgraph/{name} leads astray"
        assert not link.readlink().is_absolute(), f".typing/roomgraph/{name} leads out of the house"
