"""Processes of the tests side by side: what memory and a container leave room for."""

import pytest

import tests.workers
from tests.workers import EACH, fitting, free_memory, workers

GIB = 2**30


@pytest.mark.parametrize(
    ("processors", "free", "count"),
    [(8, 18 * GIB, 6), (2, 24 * GIB, 2), (64, 3.1 * EACH, 3), (8, 0.9 * EACH, 1), (4, float("inf"), 4)],
)
def test_there_are_as_many_as_memory_has_room_for(processors, free, count):
    assert fitting(processors, free) == count


def test_a_container_has_less_than_its_machine(tmp_path):
    assert free_memory(tmp_path) == float("inf") and workers() >= 1
    (tmp_path / "proc").mkdir()
    (tmp_path / "proc" / "meminfo").write_text("MemTotal:  32000000 kB\nMemAvailable:   16000000 kB\n")
    group = tmp_path / "sys" / "fs" / "cgroup"
    (group / "memory").mkdir(parents=True)
    assert free_memory(tmp_path) == 16_000_000 * 1024
    (group / "memory.max").write_text("max\n")
    (group / "memory.current").write_text(f"{2 * GIB}\n")
    assert free_memory(tmp_path) == 16_000_000 * 1024, "a group without a limit"
    (group / "memory.max").write_text(f"{9 * GIB}\n")
    assert free_memory(tmp_path) == 7 * GIB
    (group / "memory" / "memory.limit_in_bytes").write_text(f"{8 * GIB}\n")
    (group / "memory" / "memory.usage_in_bytes").write_text(f"{5 * GIB}\n")
    assert free_memory(tmp_path) == 3 * GIB


def test_the_tests_are_handed_out_to_so_many(pytestconfig, monkeypatch):
    """By the hook that `pytest -n auto` asks, before any count of processors that pytest has itself."""
    monkeypatch.setattr(tests.workers, "EACH", 1e18)
    assert pytestconfig.hook.pytest_xdist_auto_num_workers(config=pytestconfig) == 1
