"""``roomgraph view``: open a run in Rerun."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

HOST, WEB_PORT, DATA_PORT = "127.0.0.1", 9090, 9876


def view(
    run: Annotated[Path, typer.Argument(metavar="RUN", help="Folder of a run.")],
    web: Annotated[
        bool, typer.Option("--web", help="Open it in the browser, on this machine only.")
    ] = False,
) -> None:
    """Open a run's recording in Rerun.

    \b
    Examples:
      roomgraph view results/kitchen/latest
      roomgraph view out --web
    """  # noqa: D301
    import subprocess
    import sys
    from urllib.parse import quote

    from roomgraph.app.errors import AppError
    from roomgraph.app.storage.run_folder import RunFolder

    recording = RunFolder(run).recording
    if not recording.exists():
        raise AppError(
            "no recording to view", where=recording, expected="a run made with --save-rrd",
            hint="run the sequence again without --no-rrd",
        )  # fmt: skip
    command = [sys.executable, "-m", "rerun", str(recording)]
    if web:
        command += ["--web-viewer", "--bind", HOST, "--web-viewer-port", str(WEB_PORT)]
        command += ["--port", str(DATA_PORT)]
        source = quote(f"rerun+http://{HOST}:{DATA_PORT}/proxy", safe="")
        typer.echo(f"Open http://{HOST}:{WEB_PORT}/?url={source} on this machine; stop with Ctrl-C")
    try:
        status = subprocess.run(command, check=False).returncode
    except KeyboardInterrupt:
        return
    if status:
        raise AppError(
            "the Rerun viewer did not start", where=recording, got=f"exit status {status}",
            hint="without a display, try: roomgraph view RUN --web",
        )  # fmt: skip
