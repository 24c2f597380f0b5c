"""Running the command in this process."""

import sys

import pytest

from roomgraph.app.cli.main import main


def roomgraph(monkeypatch, *arguments):
    """Run the command; return its exit status."""
    monkeypatch.setattr(sys, "argv", ["roomgraph", *map(str, arguments)])
    with pytest.raises(SystemExit) as exit_:
        main()
    return exit_.value.code or 0
