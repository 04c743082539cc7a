"""What all tests start from."""

import gc
import os
import signal

import pytest

from tests.workers import workers

if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:  # as in what a script starts in the background
    signal.signal(signal.SIGINT, signal.default_int_handler)

os.environ.setdefault("MASONRY_COMPILERS", "1")  # tests run side by side already


@pytest.hookimpl(optionalhook=True, tryfirst=True)
def pytest_xdist_auto_num_workers() -> int:
    """`-n auto`: as many as memory has room for."""
    return workers()


def pytest_collection_finish() -> None:
    """The tests themselves are not looked through for garbage, again and again, while Numba compiles."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(20_000, 20, 20)
