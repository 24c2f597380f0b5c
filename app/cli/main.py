"""Where the ``roomgraph`` command starts."""

from __future__ import annotations

import atexit
import gc

from roomgraph.app.allocation import keep_memory


def main() -> None:
    """Prepare the process, then run the command."""
    keep_memory()
    # At the end the system takes all memory back at once: in pieces takes Python half a second.
    atexit.register(gc.freeze)
    from roomgraph.app.cli.command_line import cli

    cli()
