"""``frames.csv``: a row for every input frame, with its state and its label."""

from __future__ import annotations

from dataclasses import dataclass

from roomgraph.semantics.labels import UNKNOWN
from roomgraph.semantics.temporal.labeller import FrameLabel
from roomgraph.slam.tracking import Tracking, TrackingState

# The method of frames that a run did not get to.
UNREAD = "unread"
FRAME_COLUMNS = ("timestamp", "state", "inliers", "keyframe", "label", "score", "method")

Row = tuple[str | int, ...]


@dataclass(frozen=True, slots=True)
class LabelledFrame:
    """Results of SLAM and labelling for one frame."""

    tracking: Tracking
    label: FrameLabel

    @property
    def row(self) -> Row:
        """The frame's row."""
        tracking, label = self.tracking, self.label
        keyframe = "" if tracking.anchor is None else tracking.anchor.keyframe
        return (
            f"{tracking.stamp_s:.6f}", tracking.state.value, tracking.inliers, keyframe,
            label.label, f"{label.score:.4f}", tracking.method,
        )  # fmt: skip


def unread_row(stamp_s: float) -> Row:
    """Return the row of a frame that the run did not reach."""
    return (f"{stamp_s:.6f}", TrackingState.SKIPPED.value, 0, "", UNKNOWN, "0.0000", UNREAD)
