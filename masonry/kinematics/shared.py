"""Data shared by the parts of a step: one array, in which they find the loads of now, and leave what others ask for."""

FACTOR, FACTOR_BEFORE, SPEED, SPEED_BEFORE, DRIVE_FORCE, TRAVEL, SPARE = range(7)
"""Factor of the dead load that acts now and one step before; speed (m/s) of the drive after the step and before; force
(N) that it exerts; m, how far two blocks travel at most in this step, and how far they may until contacts are found
anew: below 0 where the step cannot be taken."""
SHARED = 7
