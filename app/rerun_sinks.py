"""Where the recording goes: a file, a window, or both at once."""

from __future__ import annotations

from pathlib import Path

import rerun as rr

from app.blueprint import build_blueprint
from app.errors import AppError

APPLICATION = "roomgraph"


def open_sinks(name: str, save: Path | None, port: int | None) -> rr.RecordingStream:
    """Open a recording that goes to a file, to a window, or to both.

    Parameters
    ----------
    name : str
        What the recording is called.
    save : Path or None
        The file.
    port : int or None
        Where the window listens on this machine; None for no window.

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
        recording.set_sinks(*sinks, default_blueprint=build_blueprint(None))
    except (OSError, RuntimeError) as error:
        raise AppError("the recording cannot be written", where=save, got=str(error)) from error
    recording.send_recording_name(name)
    return recording


def _open_window(recording: rr.RecordingStream, port: int) -> None:
    try:
        recording.spawn(port=port, connect=False, hide_welcome_screen=True)
    except (OSError, RuntimeError) as error:
        raise AppError(
            "the Rerun window does not open", expected="the program `rerun` and a display",
            got=str(error), hint="run without -v; open the recording later with `roomgraph view`",
        ) from error  # fmt: skip
