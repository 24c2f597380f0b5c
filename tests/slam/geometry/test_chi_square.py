"""Bounds of the chi-square distribution, against SciPy's."""

import pytest
from scipy.stats import chi2

from roomgraph.slam.geometry import chi_square


@pytest.mark.parametrize(
    ("bound", "share", "degrees", "digits"),
    [
        (chi_square.CHI2_95_3DOF, 0.95, 3, 2),
        (chi_square.CHI2_95_6DOF, 0.95, 6, 2),
        (chi_square.CHI2_984_6DOF, 0.984, 6, 1),
    ],
)
def test_bounds_hold_the_share_that_their_names_say(bound, share, degrees, digits):
    assert bound == round(float(chi2.ppf(share, degrees)), digits)
