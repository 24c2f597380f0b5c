"""Checks of a sequence against itself: unit of depth, camera, registration, time."""

from slam.checks.finding import Finding
from slam.checks.mending import Examination, examine
from slam.checks.sequence import CheckSettings, check_sequence

__all__ = ["CheckSettings", "Examination", "Finding", "check_sequence", "examine"]
