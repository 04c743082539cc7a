"""The compiled steps and their loops over contacts: `step.py` is Fig. 2 of the paper on one screen; `large_step.py` is
the step in large displacement, with bonds and with what blocks meet (masonry/patches)."""
