"""Bounds of the chi-square distribution on squared errors in units of their standard deviation.

Each name says the share of correct measurements that lie within the bound, in percent or, with a
third digit, in tenths of a percent, and the degrees of freedom.
"""

from __future__ import annotations

# Of a feature with depth: two pixel coordinates and an inverse depth.
CHI2_95_3DOF = 7.81
# Of a rigid motion: three of rotation and three of translation.
CHI2_95_6DOF = 12.59
CHI2_984_6DOF = 15.6
