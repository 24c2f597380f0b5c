"""Checks of a sequence: unit of depth, camera, registration, time."""

from roomgraph.slam.checks.correction import Examination, examine
from roomgraph.slam.checks.finding import Finding
from roomgraph.slam.checks.sequence import CheckSettings, check_sequence

__all__ = ["CheckSettings", "Examination", "Finding", "check_sequence", "examine"]
