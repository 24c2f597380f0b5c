"""The README is what people meet first."""

import re
from pathlib import Path

ROOT = Path(__file__).parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")


def test_it_is_short_and_finished():
    assert len(README.splitlines()) <= 120
    assert "@@" not in README


def test_what_it_links_to_is_there():
    links = re.findall(r"\]\(([^)#]+)\)", README)
    assert links
    assert [link for link in links if "://" not in link and not (ROOT / link).exists()] == []


def test_every_command_it_shows_exists():
    from roomgraph.app.cli.command_line import cli

    known = {command.name or command.callback.__name__ for command in cli.registered_commands}
    shown = set(re.findall(r"^roomgraph (\w+)", README, re.MULTILINE))
    assert shown
    assert shown <= known
