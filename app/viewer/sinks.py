"""Where the recording goes: a file, a window, or both at once."""

from __future__ import annotations

import os
import shutil
import socket
import subprocess
import sys
import time
from pathlib import Path

import pyarrow.compute  # noqa: F401  # Rerun's first message would load it, while the run waits
import rerun as rr
import rerun.blueprint as rrb

from roomgraph.app.errors import AppError

APPLICATION = "roomgraph"
PATIENCE_S = 10.0


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
        _open_window(port)
        sinks.append(rr.GrpcSink(f"rerun+http://127.0.0.1:{port}/proxy"))
    if save is not None:
        sinks.append(rr.FileSink(save))
    try:
        recording.set_sinks(*sinks, default_blueprint=blueprint)
    except (OSError, RuntimeError) as error:
        raise AppError("the recording cannot be written", where=save, got=str(error)) from error
    recording.send_recording_name(name)
    return recording


def find_viewer() -> str:
    """Return the program that opens windows.

    Raises
    ------
    AppError
        It is not there, or there is no display to open one on.
    """
    # The viewer comes with the package: its program lies beside the interpreter.
    program = shutil.which("rerun", path=str(Path(sys.executable).parent))
    headless = sys.platform == "linux" and not {"DISPLAY", "WAYLAND_DISPLAY"} & os.environ.keys()
    if program is None or headless:
        raise _no_window("no display" if program else "no program `rerun`")
    return program


def _open_window(port: int) -> None:
    """Open the viewer's window, reachable from this machine only."""
    window = subprocess.Popen(
        [find_viewer(), "--bind", "127.0.0.1", "--port", str(port), "--hide-welcome-screen"],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True,
    )  # fmt: skip
    give_up = time.monotonic() + PATIENCE_S
    while time.monotonic() < give_up and window.poll() is None:
        try:
            socket.create_connection(("127.0.0.1", port), timeout=1.0).close()
            return
        except OSError:
            time.sleep(0.1)
    raise _no_window(f"exit status {window.poll()}" if window.poll() is not None else "no answer")


def _no_window(got: str) -> AppError:
    return AppError(
        "the Rerun window does not open", expected="the program `rerun` and a display", got=got,
        hint="leave out -v and open the recording later with `roomgraph view`",
    )  # fmt: skip
