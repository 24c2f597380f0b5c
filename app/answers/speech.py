"""Speech output of where a person is: what to say when, and speaking it."""

from __future__ import annotations

import re
import shutil
import subprocess
from dataclasses import dataclass, field

from roomgraph.app.errors import AppError
from roomgraph.semantics.labels import UNKNOWN

# Two-stream topological localization, section IV.A: "you are entering" once the answer has
# changed over 5 continuous frames, "you are in" every 10 seconds.
HOLD_FRAMES = 5
REPEAT_S = 10.0


@dataclass
class Announcer:
    """Decides when to announce a place. Frames without an answer are ignored."""

    hold_frames: int = HOLD_FRAMES
    repeat_s: float = REPEAT_S
    _place: str = field(default=UNKNOWN, init=False)
    _candidate: str = field(default=UNKNOWN, init=False)
    _held: int = field(default=0, init=False)
    _said_s: float = field(default=0.0, init=False)

    def hear(self, place: str, stamp_s: float) -> str | None:
        """Process a frame's answer and its time; return what to say now, if anything."""
        if place != UNKNOWN:
            self._held = self._held + 1 if place == self._candidate else 1
            self._candidate = place
            if place != self._place and self._held >= self.hold_frames:
                return self._say("entering" if self._place != UNKNOWN else "in", place, stamp_s)
        if self._place != UNKNOWN and stamp_s - self._said_s >= self.repeat_s:
            return self._say("in", self._place, stamp_s)
        return None

    def _say(self, verb: str, place: str, stamp_s: float) -> str:
        self._place, self._said_s = place, stamp_s
        return f"you are {verb} {spoken(place)}"


class Voice:
    """Speaks sentences with espeak-ng, one after the other.

    Raises
    ------
    AppError
        The program is not installed.
    """

    def __init__(self) -> None:
        program = shutil.which("espeak-ng")
        if program is None:
            raise AppError(
                "no speech program", where="--speak", expected="the program espeak-ng",
                hint="install it (Debian: apt-get install espeak-ng), or leave out --speak",
            )  # fmt: skip
        self._program = program

    def say(self, sentence: str) -> None:
        """Speak a sentence and wait until it ends.

        Raises
        ------
        AppError
            The program fails, for example without a sound card.
        """
        done = subprocess.run(
            [self._program, "--", sentence], capture_output=True, text=True, check=False
        )
        said = done.stderr.strip().splitlines()
        # Without a sound card it complains, but ends as if all were well.
        if done.returncode or (said and "error" in said[-1].lower()):
            raise AppError(
                "speech output failed", where=self._program,
                got=said[-1] if said else f"exit status {done.returncode}",
                hint="check the sound card, or leave out --speak",
            )  # fmt: skip


def spoken(place: str) -> str:
    """Return a place's name as it is spoken: ``meeting_room2`` is "meeting room 2"."""
    return re.sub(r"(?<=\D)(\d+)$", r" \1", place.replace("_", " "))
