"""The tracking status of the camera."""

from __future__ import annotations

import logging
from enum import StrEnum

from roomgraph.datasets.frame import Frame

logger = logging.getLogger(__name__)


class TrackingPhase(StrEnum):
    """Tracking phase after the latest frame."""

    INITIALISING = "initialising"
    """No frame has shown anything in depth yet: there is no map."""
    TRACKING = "tracking"
    """The latest frame has a pose."""
    INTERRUPTED = "interrupted"
    """Tracked until frames came that could not be followed and show nothing in depth."""
    LOST = "lost"
    """A frame that shows enough was not found in the map, nor has one been since."""


class TrackingStatus:
    """The tracking status, changed only by its transitions.

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
        """Whether the latest frame has a pose; only then is the last motion known."""
        return self.phase is TrackingPhase.TRACKING

    @property
    def is_lost(self) -> bool:
        """Whether relocalisation is needed."""
        return self.phase is TrackingPhase.LOST

    def began(self, frame: Frame) -> None:
        """Continue from the first frame of the map."""
        self._seen(frame)

    def began_submap(self, frame: Frame) -> None:
        """Continue from a lost frame that begins a sub-map."""
        self._seen(frame)

    def found(self, frame: Frame, by_flow: bool) -> None:
        """Continue from a frame with a pose in the map; `by_flow` if by optical flow."""
        self.needs_features = not by_flow
        self.lost_in_a_row = 0
        self._seen(frame)

    def interrupted(self, frame: Frame) -> None:
        """Record an untracked frame without depth for relocalisation."""
        self.needs_features = True
        self._enter(TrackingPhase.LOST if self.is_lost else TrackingPhase.INTERRUPTED, frame)

    def lost(self, frame: Frame) -> None:
        """Record a frame with depth whose pose was not found."""
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
