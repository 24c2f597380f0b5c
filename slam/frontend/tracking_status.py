"""Whether the camera is being tracked, and since when it is not."""

from __future__ import annotations

import logging
from enum import StrEnum

from roomgraph.datasets.frame import Frame

logger = logging.getLogger(__name__)


class TrackingPhase(StrEnum):
    """What tracking knows of the camera after the latest frame."""

    INITIALISING = "initialising"
    """No frame has shown anything in depth yet: there is no map."""
    TRACKING = "tracking"
    """The latest frame has a pose."""
    INTERRUPTED = "interrupted"
    """Tracked until frames came that could not be followed and show nothing in depth."""
    LOST = "lost"
    """A frame that shows enough was not found in the map, nor has one been since."""


class TrackingStatus:
    """The one account of whether the camera is tracked; changed by its transitions alone.

    They are called when all that is to be done about a frame is done: until then the status is
    that of the frame before.

    Attributes
    ----------
    phase : TrackingPhase
        After the latest frame.
    last_seen_s : float
        Time stamp of the latest frame with a pose, seconds.
    lost_in_a_row : int
        Frames that were lost since one was found; a sub-map that begins does not end the row.
    needs_features : bool
        Whether the frames to come are likely to need features, so that it pays to extract them
        ahead.
    """

    def __init__(self) -> None:
        self.phase = TrackingPhase.INITIALISING
        self.last_seen_s = 0.0
        self.lost_in_a_row = 0
        self.needs_features = False

    @property
    def is_initialising(self) -> bool:
        """Whether there is no map yet."""
        return self.phase is TrackingPhase.INITIALISING

    @property
    def is_tracking(self) -> bool:
        """Whether the latest frame has a pose: only then the motion since is known."""
        return self.phase is TrackingPhase.TRACKING

    @property
    def is_lost(self) -> bool:
        """Whether the camera has to be found again."""
        return self.phase is TrackingPhase.LOST

    def began(self, frame: Frame) -> None:
        """Go on from the frame that the map begins with."""
        self._seen(frame)

    def began_submap(self, frame: Frame) -> None:
        """Go on from a lost frame that a sub-map begins with."""
        self._seen(frame)

    def found(self, frame: Frame, by_flow: bool) -> None:
        """Go on from a frame with a pose in the map; `by_flow` if optical flow was enough."""
        self.needs_features = not by_flow
        self.lost_in_a_row = 0
        self._seen(frame)

    def interrupted(self, frame: Frame) -> None:
        """Take note of a frame that could not be followed and has no depth to find it by."""
        self.needs_features = True
        self._enter(TrackingPhase.LOST if self.is_lost else TrackingPhase.INTERRUPTED, frame)

    def lost(self, frame: Frame) -> None:
        """Take note of a frame that has depth, but was not found."""
        self.needs_features = True
        self.lost_in_a_row += 1
        self._enter(TrackingPhase.LOST, frame)

    def _seen(self, frame: Frame) -> None:
        self.last_seen_s = frame.stamp_s
        self._enter(TrackingPhase.TRACKING, frame)

    def _enter(self, phase: TrackingPhase, frame: Frame) -> None:
        if phase is not self.phase:
            logger.info("frame %d: %s -> %s", frame.index, self.phase, phase)
        self.phase = phase
