"""The viewer in the browser: there, and on this machine only."""

import os
import signal
import socket
import subprocess
import sys
import time
import urllib.request
from pathlib import Path

import pytest

CODE = """
import signal, sys
from pathlib import Path
from roomgraph.app.cli.commands import view
# A job in the background inherits that interrupts are ignored.
signal.signal(signal.SIGINT, signal.default_int_handler)
view.WEB_PORT, view.DATA_PORT = int(sys.argv[2]), int(sys.argv[3])
view.view(Path(sys.argv[1]), web=True)
"""
PATIENCE_S = 60.0


def _free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def _page(port):
    """Return what is served at a port, as soon as anything is."""
    give_up = time.monotonic() + PATIENCE_S
    while time.monotonic() < give_up:
        try:
            with urllib.request.urlopen(f"http://127.0.0.1:{port}/", timeout=5) as answer:
                return answer.read()
        except OSError:
            time.sleep(0.2)
    pytest.fail(f"nothing answers at port {port}")


def _listening(port):
    """Return the addresses (hexadecimal, as Linux has them) at which a port is listened to."""
    found = set()
    for table in ("/proc/net/tcp", "/proc/net/tcp6"):
        for line in Path(table).read_text().splitlines()[1:]:
            _, local, _, state, *_ = line.split()
            address, at = local.split(":")
            if state == "0A" and int(at, 16) == port:
                found.add(address)
    return found


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_the_web_viewer_answers_on_this_machine_only(mapped):
    ports = _free_port(), _free_port()
    viewer = subprocess.Popen(
        [sys.executable, "-c", CODE, str(mapped[1]), *map(str, ports)],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True,
        env={**os.environ, "BROWSER": "true", "PYTHONUNBUFFERED": "1"},
    )  # fmt: skip
    try:
        assert b"<html" in _page(ports[0]).lower()
        assert [_listening(port) for port in ports] == [{"0100007F"}, {"0100007F"}]
    finally:
        os.killpg(viewer.pid, signal.SIGINT)
        said, _ = viewer.communicate(timeout=PATIENCE_S)
    assert f"http://127.0.0.1:{ports[0]}/?url=rerun%2Bhttp" in said
    assert "Traceback" not in said
