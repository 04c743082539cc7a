"""How many threads a run takes where that is left to the program."""

import os

import pytest

from masonry.errors import SceneError
from masonry.laboratory import arguments
from masonry.runtime import processors
from masonry.runtime.processors import AUTO
from masonry.timeloop import threads
from masonry.timeloop.threads import WORTH, threads_for
from tests.cli.test_cli import main
from verification.reference_step import models, specimens
from verification.scene_runs import assembled


@pytest.fixture
def idle(monkeypatch):
    monkeypatch.setattr(threads, "free_processors", lambda: 16)


def test_a_thread_for_each_part_of_a_size(idle):
    model = models.model_of(*specimens.bricks((6, 6, 6), (2, 2, 2)), kind="tets")
    size = len(model.group) + len(model.layout.mesh.tets)
    assert threads_for(model, AUTO) == size // WORTH > 1
    assert threads_for(models.model_of(*specimens.bricks((2, 2, 2), (1, 1, 1)), kind="tets"), AUTO) == 1
    assert threads_for(model, 3) == 3


def test_large_displacement_has_one(idle):
    assert threads_for(assembled("dry-wall").model, AUTO) == 1


def test_a_busy_machine_has_one_for_any_size(monkeypatch):
    monkeypatch.setattr(os, "getloadavg", lambda: (99.0, 0.0, 0.0))
    model = models.model_of(*specimens.bricks((6, 6, 6), (2, 2, 2)), kind="tets")
    assert threads_for(model, AUTO) == 1
    monkeypatch.setattr(os, "getloadavg", lambda: (0.99, 0.0, 0.0))
    assert processors.free_processors() == processors.processors()


def test_a_wrong_word_is_told_with_what_is_allowed(capsys):
    assert main(["run", "couplet", "--threads", "many"]) == 2
    assert "nor auto" in capsys.readouterr().err
    with pytest.raises(SceneError, match='"auto", or a number of threads from 1 to'):
        arguments.threads("many")
