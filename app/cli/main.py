"""Entry point of the ``roomgraph`` command."""

from __future__ import annotations

import atexit
import gc

from roomgraph.app.allocation import keep_memory


def main() -> None:
    """Prepare the process, then run the command."""
    keep_memory()
    # At exit the system frees all memory at once; Python takes half a second to free each object.
    atexit.register(gc.freeze)
    from roomgraph.app.cli.command_line import cli

    cli()
