"""A run of a sweep whose doubts were edited by hand: its row is judged by the numbers."""

import json

import pytest

from masonry.sweeps.run_store import Store


@pytest.mark.parametrize("doubts", [5, "overlap", [5], [{}], None])
def test_doubts_that_cannot_be_read_are_found_again(tmp_path, doubts):
    store = Store(tmp_path)
    folder = tmp_path / "runs" / "key"
    folder.mkdir()
    (folder / "history.h5").touch()
    summary = {"energy_imbalance": 0.5, "verdict": "sound", "doubts": doubts, "not_measured": []}
    (folder / "summary.json").write_text(json.dumps(summary))
    row = store.row("key")
    assert row is not None and row["verdict"] == "with care" and "energy_balance" in row["doubts"].split(", ")
