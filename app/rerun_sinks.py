"""Where the recording goes: a file, a window, or both at once."""

from __future__ import annotations

import shutil
import socket
import sys
from pathlib import Path

import rerun as rr
import rerun.blueprint as rrb

from app.errors import AppError

APPLICATION = "roomgraph"


def open_sinks(
    name: str, save: Path | None, port: int | None, blueprint: rrb.Blueprint
) -> rr.RecordingStream:
    """Open a recording that goes to a file, to a window, or to both.

    Parameters
    ----------
    name : str
        What the recording is called.
    save : Path or None
        The file.
    port : int or None
        Where the window listens on this machine; None for no window.
    blueprint : Blueprint
        The layout to begin with.

    Raises
    ------
    AppError
        The file cannot be written, or the window cannot be opened.
    """
    recording = rr.RecordingStream(APPLICATION)
    recording.set_log_time_enabled(False)
    recording.set_log_tick_enabled(False)
    sinks: list[rr.FileSink | rr.GrpcSink] = []
    if port is not None:
        _open_window(recording, port)
        sinks.append(rr.GrpcSink(f"rerun+http://127.0.0.1:{port}/proxy"))
    if save is not None:
        sinks.append(rr.FileSink(save))
    try:
        recording.set_sinks(*sinks, default_blueprint=blueprint)
    except (OSError, RuntimeError) as error:
        raise AppError("the recording cannot be written", where=save, got=str(error)) from error
    recording.send_recording_name(name)
    return recording


def _open_window(recording: rr.RecordingStream, port: int) -> None:
    """Open the viewer's window, or find the one that is open already."""
    # The viewer comes with the package: its program lies beside the interpreter.
    program = shutil.which("rerun", path=str(Path(sys.executable).parent))
    try:
        rr.spawn(
            port=port, connect=False, hide_welcome_screen=True, executable_path=program,
            recording=recording,
        )  # fmt: skip
        socket.create_connection(("127.0.0.1", port), timeout=2.0).close()
    except (OSError, RuntimeError) as error:
        raise AppError(
            "the Rerun window does not open", expected="the program `rerun` and a display",
            got=str(error).strip().split("\n")[0],
            hint="leave out -v and open the recording later with `roomgraph view`",
        ) from error  # fmt: skip
