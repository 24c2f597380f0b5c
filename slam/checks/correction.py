"""Checking a sequence, and correcting its camera where the images show how."""

from __future__ import annotations

from dataclasses import dataclass, replace

from roomgraph.datasets.sequence import Sequence
from roomgraph.slam.checks.finding import Finding
from roomgraph.slam.checks.sequence import CheckSettings, check_sequence
from roomgraph.slam.geometry.noise import SensorNoise


@dataclass(frozen=True, slots=True)
class Examination:
    """What was found in a sequence, and the sequence as far as it could be corrected.

    Attributes
    ----------
    sequence : Sequence
        With another camera than the one examined, if that was corrected.
    findings : tuple of Finding
        First what was corrected, then what is left.
    """

    sequence: Sequence
    findings: tuple[Finding, ...]


def examine(sequence: Sequence, settings: CheckSettings, noise: SensorNoise) -> Examination:
    """Check a sequence; correct its camera where the images show what would be right.

    One thing is corrected at a time, and only if the finding is gone with it: depth that does
    not lie on colour first, as points do not move rigidly before it does. `noise` is that of the
    sensor that took the sequence.
    """
    told: list[Finding] = []
    findings = check_sequence(sequence, settings, noise)
    while settings.correct_camera:
        correctable = next((f for f in findings if f.correction is not None), None)
        if correctable is None or correctable.correction is None:
            break
        corrected = sequence.with_camera(correctable.correction.camera)
        after = check_sequence(corrected, settings, noise)
        if {f.kind for f in after} & {f.kind for f in (*told, correctable)}:
            break
        told.append(replace(correctable, suggestion=correctable.correction.words, correction=None))
        sequence, findings = corrected, after
    return Examination(sequence, (*told, *findings))
