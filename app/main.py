"""Where the ``roomgraph`` command starts."""

from __future__ import annotations

import atexit
import gc
import sys
from importlib.util import find_spec
from pathlib import Path

from app.allocation import keep_memory


def main() -> None:
    """Check that we are whole, then run the command."""
    found = find_spec("datasets")
    ours = Path(__file__).resolve().parent.parent / "datasets"
    if found is None or found.origin is None or Path(found.origin).resolve().parent != ours:
        sys.stderr.write(
            "roomgraph: another package named 'datasets' is in the way: "
            f"{found.origin if found else 'none found'}; expected {ours}; "
            "install roomgraph into an environment of its own\n"
        )
        sys.exit(1)
    keep_memory()
    # At the end the system takes all memory back at once: in pieces takes Python half a second.
    atexit.register(gc.freeze)
    from app.cli import cli

    cli()
