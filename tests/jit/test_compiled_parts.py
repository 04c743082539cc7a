"""Parts of steps: what is compiled for a law or a kind of bodies serves every scene that has it."""

import itertools
import os
import subprocess
import sys
from typing import Any, NamedTuple

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.configuration.chunk import Chunk
from masonry.configuration.configuration import configuration_of
from masonry.jit.compiled_parts import CompiledPart
from masonry.jit.records import ArgumentRecord, kind_of, unpack
from masonry.kinematics.motion import Guided
from masonry.kinematics.shared import SHARED
from masonry.scene import load

LAWS, BODIES, DISPLACEMENTS = ("exponential", "linear", "brittle"), ("rigid", "affine"), ("small", "large")


def parts_of_a_step(law: str, bodies: str, displacements: str) -> set[str]:
    """The names of what a couplet's step is compiled to."""
    model = assemble(load("couplet", [f"law={law}", f"kinematics={bodies}", f"displacements={displacements}"])).model
    calls = configuration_of(model).program(1, np.zeros(SHARED)).all_calls
    return {call.part.stamp(call.kind) for call in calls}


@pytest.fixture(scope="module")
def parts() -> dict[tuple[str, str, str], set[str]]:
    return {
        combination: parts_of_a_step(*combination) for combination in itertools.product(LAWS, BODIES, DISPLACEMENTS)
    }


def test_a_new_combination_of_law_bodies_and_displacements_needs_nothing_that_others_have_not(parts):
    """Twelve combinations, of which each is covered by two others that share no more than one thing with it."""
    for law, bodies, displacements in parts:
        others = (
            own
            for (other_law, other_bodies, other_displacements), own in parts.items()
            if (other_law == law) + ((other_bodies, other_displacements) == (bodies, displacements)) == 1
        )
        assert parts[law, bodies, displacements] <= set().union(*others)


def test_the_parts_of_all_combinations_are_a_sum_and_no_product(parts):
    of_laws = {law: set.intersection(*(own for key, own in parts.items() if law in key)) for law in LAWS}
    assert all(len(own) >= 1 for own in of_laws.values())
    whole = set().union(*parts.values())
    assert len(whole) < 0.4 * sum(map(len, parts.values()))


class Numbers(NamedTuple):
    few: Any
    many: Any
    none: Any = None


@CompiledPart
def _echo(record):
    (few, many, none), flag, whole, small, out = unpack(record)
    out[0] = few
    out[1] = many[1, 2]
    out[2] = 1.0 if none is None else 2.0
    out[3] = 1.0 if flag else 0.0
    out[4] = whole
    out[5] = small
    many[0, 0] = -1.0


@pytest.mark.parametrize("layout", ["C", "F", "strided"])
def test_a_part_finds_its_arguments_in_a_record(layout):
    many, out = np.arange(12.0).reshape(3, 4), np.zeros(6)
    many = {"C": many, "F": np.asfortranarray(many), "strided": np.repeat(many, 2, axis=1)[:, ::2]}[layout]
    _echo.of(Numbers(0.1, many), True, -3, np.uint32(2**31 + 7), out)()
    assert out.tolist() == [0.1, 6.0, 1.0, 1.0, -3.0, 2.0**31 + 7.0]
    assert many[0, 0] == -1.0, "arrays are shared"


def test_another_value_of_an_argument_goes_to_the_record_that_there_is():
    old, out = Numbers(0.1, np.zeros((2, 3))), np.zeros(6)
    call = _echo.of(old, False, 1, np.uint32(1), out)
    call()
    addresses, new = call.addresses, Numbers(0.2, np.full((3, 4), 7.0))
    call.replace(old, new)
    call()
    assert out[:2].tolist() == [0.2, 7.0]
    assert (new.many[0, 0], old.many[0, 0]) == (-1.0, -1.0)
    assert call.addresses == addresses


def test_a_program_stays_where_the_numbers_of_its_damping_change_alone():
    """It is put together anew for a damping of another kind; steps are those of a model that had it from the start."""
    first, later = Guided(0.05, 0.01), Guided(0.2, 0.01)
    steppers = {}
    for name, dampings in {"changed": (first, later), "from the start": (later,), "another kind": (0.8, later)}.items():
        model = assemble(load("couplet", ["drive.steps=1000"])).model
        configuration, steppers[name] = configuration_of(model), []
        for damping in dampings:
            model.damping = damping
            configuration.advance(Chunk(np.ones(1), np.ones(1), False), 1, 0, 0, np.zeros(0))
            steppers[name].append(configuration.stepper.program)
        model.bodies.rigid.v[...] = 1e-3
        configuration.advance(Chunk(np.ones(4), np.zeros(4), False), 1, 0, 3, np.zeros(3))
        steppers[name].append(model.bodies.rigid.v.copy())
    assert steppers["changed"][0] is steppers["changed"][1]
    assert steppers["another kind"][0] is not steppers["another kind"][1]
    assert np.array_equal(steppers["changed"][-1], steppers["from the start"][-1])
    assert np.array_equal(steppers["another kind"][-1], steppers["from the start"][-1])


def test_a_record_refuses_what_it_has_no_room_for():
    with pytest.raises(TypeError, match="no room for complex128"):
        ArgumentRecord(kind_of(1j), (1j,))


@pytest.mark.slow
def test_what_is_compiled_side_by_side_is_what_one_process_compiles(tmp_path):
    """By one process and by two, each with an empty cache: the same stress."""
    run = "import masonry; print(repr(masonry.run('column-pushed').history.rows['stress'].tolist()))"
    answers = [
        subprocess.run(
            [sys.executable, "-c", run],
            env=os.environ | {"MASONRY_CACHE": str(tmp_path / count), "MASONRY_COMPILERS": count},
            capture_output=True, text=True, check=True, timeout=600,
        ).stdout
        for count in ("1", "2")
    ]  # fmt: skip
    assert answers[0] == answers[1]
