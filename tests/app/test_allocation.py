"""Memory that was freed stays with the process."""

from __future__ import annotations

import platform
import subprocess
import sys

import pytest

_FRAMES = """
import resource
import sys
from threading import Thread

import numpy as np

from roomgraph.app.allocation import keep_memory


def frames():
    for _ in range(100):
        images = [np.ones(1 << 20, np.uint8) for _ in range(10)]
        del images


if sys.argv[1] == "keep":
    keep_memory()
before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
reader = Thread(target=frames)
reader.start()
reader.join()
print(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)
"""


def _page_faults(how: str) -> int:
    command = [sys.executable, "-c", _FRAMES, how]
    return int(subprocess.run(command, capture_output=True, text=True, check=True).stdout)


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="a setting of glibc")
@pytest.mark.slow
def test_what_frames_took_is_not_fetched_again() -> None:
    whole = 10 * 256  # pages of a frame's images
    assert _page_faults("keep") < 4 * whole
    assert _page_faults("leave") > 20 * whole
