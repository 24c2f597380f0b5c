"""Looking at a sequence, and mending its camera where the data says how."""

from __future__ import annotations

from dataclasses import dataclass, replace

from roomgraph.datasets.sequence import Sequence
from roomgraph.slam.checks.finding import Finding
from roomgraph.slam.checks.sequence import CheckSettings, check_sequence


@dataclass(frozen=True, slots=True)
class Examination:
    """What was found in a sequence, and the sequence as far as it could be mended.

    Attributes
    ----------
    sequence : Sequence
        With another camera than the one examined, if that was mended.
    findings : tuple of Finding
        First what was mended, then what is left.
    """

    sequence: Sequence
    findings: tuple[Finding, ...]


def examine(sequence: Sequence, settings: CheckSettings) -> Examination:
    """Look for what the data says against itself; where it says what would be right, take that.

    One thing is mended at a time, and only if the contradiction is gone with it: depth that does
    not lie on colour first, as points do not move rigidly before it does.
    """
    told: list[Finding] = []
    findings = check_sequence(sequence, settings)
    while settings.correct_camera:
        curable = next((f for f in findings if f.correction is not None), None)
        if curable is None or curable.correction is None:
            break
        mended = sequence.with_camera(curable.correction.camera)
        after = check_sequence(mended, settings)
        if {f.kind for f in after} & {f.kind for f in (*told, curable)}:
            break
        told.append(replace(curable, suggestion=curable.correction.words, correction=None))
        sequence, findings = mended, after
    return Examination(sequence, (*told, *findings))
