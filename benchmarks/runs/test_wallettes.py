"""The block-size study of the paper, Figs 15 and 16, in one go: 218, 335 and 540 cells in both modes, and the grid."""

import time

from masonry.laboratory import laboratory
from masonry.scene import load

STUDY = [f"wallette-mode-{mode}-{cells}" for mode in (1, 2) for cells in (218, 335, 540)] + ["wallette-mode-1"]


def test_the_seven_wallettes_of_the_block_size_study(figure):
    whole = stepping = compiling = 0.0
    for name in STUDY:
        begun = time.perf_counter()
        summary = laboratory.run(load(name, {"drive.accuracy": 0.01})).summary
        whole += time.perf_counter() - begun
        stepping += summary["seconds_run"]
        compiling += summary["seconds_compile"]
        energy = summary["energy_j"]
        assert not summary["stopped"]
        assert abs(energy["imbalance"]) < 1e-6 * energy["external_work"], f"{name}: the energy balance does not close"
    figure("seven wallettes at 1 %, cells and all, compile apart", whole - compiling, "s", 60.0, 15.0)
    figure("  of which stepping", stepping, "s")
