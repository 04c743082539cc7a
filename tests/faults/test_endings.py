"""A signal ends every command in seconds, with one plain line and its exit code, wherever native code is at work."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from textwrap import dedent, indent

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.configuration.chunk import Chunk
from masonry.configuration.configuration import configuration_of
from masonry.kinematics.shared import SHARED
from masonry.runtime.interrupts import interruptible
from masonry.scene import load

WORD = {signal.SIGINT: (130, "interrupted"), signal.SIGTERM: (143, "terminated"), signal.SIGHUP: (129, "hung up")}
PLACES = {
    "a validator of pydantic": """
        from typing import Annotated
        from pydantic import BaseModel, BeforeValidator
        class Model(BaseModel):
            number: Annotated[int, BeforeValidator(lambda value: [os.kill(os.getpid(), number), list(range(1000))])]
        Model(number=1)""",
    "the name of a field, which Python makes a RuntimeError of": """
        class Field:
            def __set_name__(self, owner, name):
                os.kill(os.getpid(), number)
                list(map(abs, range(1000)))
        type("Owner", (), {"field": Field()})""",
    "a callback of C, which says that it was ignored": """
        import ctypes
        compare = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p)
        sort = lambda a, b: os.kill(os.getpid(), number) or len(list(map(abs, range(1000)))) * 0
        ctypes.CDLL(None).qsort((ctypes.c_int * 2)(2, 1), 2, 4, compare(sort))
        while True: time.sleep(0.1)""",
    "a library that takes every error for its own": """
        while True:
            try: os.kill(os.getpid(), number); time.sleep(10)
            except BaseException: number = 0""",
    "native code that works for minutes": """
        import threading, hashlib
        threading.Timer(0.2, os.kill, (os.getpid(), number)).start()
        hashlib.pbkdf2_hmac("sha256", b"", b"", 10**9)""",
    "a solver that is asked between its iterations": """
        from masonry.runtime.interrupts import interrupt_afterwards
        with interrupt_afterwards() as pressed:
            os.kill(os.getpid(), number)
            while not pressed: pass""",
}
COMMAND = """
import os, sys, time
from masonry.cli import main
from masonry.cli.commands import scene_commands
def act(words):
    number = {number}
{place}
scene_commands.list_scenes = act
sys.exit(main.main(["list"]))
"""


@pytest.mark.parametrize("place", PLACES)
def test_a_signal_ends_a_command_in_one_line_wherever_it_is_raised(place):
    numbers = list(WORD) if "pydantic" in place else [signal.SIGTERM]
    for number in numbers:
        code, word = WORD[number]
        text = COMMAND.format(number=int(number), place=indent(dedent(PLACES[place]), "    "))
        done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, timeout=60)
        assert done.returncode == code
        assert done.stderr.startswith(f"masonry: {word}") and done.stderr.count("\n") == 1


STARTED = """
import os, signal, sys
import {module}
{module}.{name} = lambda *words, **more: os.kill(os.getpid(), signal.SIGTERM)
from masonry.cli.main import main
sys.exit(main(sys.argv[1:]))
"""


@pytest.mark.parametrize(
    ("module", "name", "words"),
    [
        ("masonry.limit_analysis.analysis", "analyse", ["limit", "arch-tilted"]),
        ("masonry.importing.importing", "guarded", ["import", "wall.obj", "--out", "scene.toml"]),
        ("masonry.laboratory.laboratory", "run", ["run", "couplet", "--out", "out"]),
        ("verification.paper.gathering", "gather", ["paper", "--out", "out"]),
        ("masonry.sweeps.engine", "run_alone", ["sweep", "sweep.toml", "--out", "out"]),
    ],
)
def test_each_command_says_a_word_and_leaves_nothing_half_done(module, name, words, tmp_path):
    (tmp_path / "sweep.toml").write_text('scene = "couplet"\ngrid = {confinement = ["0.1 MPa"]}\n')
    text = STARTED.format(module=module, name=name)
    done = subprocess.run([sys.executable, "-c", text, *words], cwd=tmp_path, capture_output=True, text=True)
    last = done.stderr.splitlines()[-1]
    assert done.returncode == 143 and "Traceback" not in done.stderr
    assert last.startswith("masonry: ") and ("before there were results" in last or "the same command" in last)
    assert not list(tmp_path.rglob("*unfinished*")) and not list(tmp_path.rglob("checkpoint"))


def started(words: list[str], cwd: Path, cache: Path) -> subprocess.Popen:
    surroundings = os.environ | {"MASONRY_CACHE": str(cache), "PYTHONUNBUFFERED": "1"}
    return subprocess.Popen([sys.executable, *words], cwd=cwd, env=surroundings, stderr=subprocess.PIPE, text=True)


@pytest.mark.parametrize("number", [signal.SIGTERM, pytest.param(signal.SIGINT, marks=pytest.mark.slow)])
def test_a_signal_ends_a_run_while_its_step_is_compiled(number, tmp_path):
    process = started(["-m", "masonry", "run", "couplet", "--out", "out"], tmp_path, tmp_path / "cache")
    said = ""
    while "compiling" not in said:
        said += process.stderr.readline()
    time.sleep(0.5)
    process.send_signal(number)
    said += process.communicate(timeout=120)[1]
    assert process.returncode == WORD[number][0] and "Traceback" not in said
    assert said.splitlines()[-1] == f"masonry: {WORD[number][1]} before there were results"
    assert_cut_off(tmp_path)
    assert not (tmp_path / "out").exists()


def assert_cut_off(folder: Path) -> None:
    """Some parts of the couplet's step may have been compiled before, but not all."""
    calls = configuration_of(assemble(load("couplet")).model).program(1, np.zeros(SHARED)).all_calls
    assert len(list(folder.rglob("*.compiled"))) < len(calls)


WAITING = """
import hashlib, os, signal, sys, threading, _thread
from masonry.runtime.interrupts import interruptible_wait
press = {"a signal": lambda: os.kill(os.getpid(), signal.SIGINT), "a thread": _thread.interrupt_main}[sys.argv[1]]
threading.Timer(0.3, press).start()
interruptible_wait(lambda: hashlib.pbkdf2_hmac("sha256", b"", b"", 10**9))
"""


@pytest.mark.parametrize("by", ["a signal", "a thread"])
def test_python_ends_while_native_code_is_at_work_and_does_not_take_its_libraries_down(by):
    """By our own code: where Python took all down beneath the native code, it would end by SIGINT, or crash."""
    done = subprocess.run([sys.executable, "-c", WAITING, by], capture_output=True, text=True, timeout=60)
    assert done.returncode == 130, done.stderr
    assert done.stderr.startswith("Traceback") and done.stderr.endswith("\nKeyboardInterrupt\n")


NOTEBOOK = """
import sys, threading, time, _thread
import masonry
from masonry.laboratory import laboratory
def press():
    while not any("(do)" in thread.name for thread in threading.enumerate()):  # the one that compiles
        time.sleep(0.01)
    time.sleep(0.3)
    _thread.interrupt_main()
said = lambda step, steps, note: threading.Thread(target=press).start() if "compiling" in note else None
try:
    laboratory.run(masonry.load("couplet"), progress=said)
except KeyboardInterrupt:
    print("it went on", file=sys.stderr)
    raise
"""


def test_ctrl_c_in_python_is_heard_while_a_step_is_compiled(tmp_path):
    process = started(["-c", NOTEBOOK], tmp_path, tmp_path / "cache")
    said = process.communicate(timeout=120)[1]
    assert process.returncode == 130 and "it went on" in said, said
    assert said.endswith("\nKeyboardInterrupt\n")
    assert_cut_off(tmp_path)


def test_a_run_that_has_not_begun_ends_by_the_first_signal():
    with interruptible() as asked, pytest.raises(KeyboardInterrupt):
        os.kill(os.getpid(), signal.SIGTERM)
    assert asked.code == 143


@pytest.mark.parametrize("scene", ["couplet", "block-rocking"])
def test_while_steps_are_taken_other_threads_hear_of_signals_and_of_a_parent_that_died(scene):
    """Half a second of steps in one call; where they kept the interpreter to themselves, no thread could look."""
    model, looks, over = assemble(load(scene)).model, [], threading.Event()
    configuration = configuration_of(model)

    def look() -> None:
        while not over.wait(0.01):
            looks.append(time.perf_counter())

    def take(steps: int) -> float:
        begun = time.perf_counter()
        configuration.advance(Chunk(np.zeros(steps + 1), np.zeros(steps + 1), False), 1, 0, steps, np.zeros(steps))
        return time.perf_counter() - begun

    take(1)
    steps = int(0.5 / (take(1000) / 1000)) + 1
    thread = threading.Thread(target=look)
    thread.start()
    begun, seconds = time.perf_counter(), take(steps)
    over.set()
    thread.join()
    assert sum(begun + 0.1 * seconds < moment < begun + 0.9 * seconds for moment in looks) >= 2
