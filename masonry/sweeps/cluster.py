"""Tasks done by the workers of a Dask cluster that somebody started: `dask scheduler`, and `dask worker ADDRESS`."""

import logging
import threading
import time
from collections.abc import Callable, Generator, Sequence
from typing import Any

from masonry.errors import SceneError, extra
from masonry.runtime.processes import Lost

PATIENCE = 5.0
"""Seconds for a scheduler to answer."""
ALONE = threading.Lock()


def require(scheduler: str) -> None:
    """Raise SceneError where Dask is not installed, no scheduler answers, or it has no workers."""
    _client(scheduler).close()


def _client(scheduler: str) -> Any:
    try:
        from dask.distributed import Client
        from distributed.comm import get_address_host_port
    except ImportError:
        raise SceneError(f"--scheduler needs Dask; {extra('cluster')}") from None
    logging.getLogger("distributed.client").setLevel(logging.CRITICAL)  # it logs a traceback for what is said below
    try:
        get_address_host_port(scheduler)  # a client that was never one says so when it is forgotten
        client = Client(scheduler, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError, TimeoutError) as error:
        why = str(error).partition("\n")[0] or type(error).__name__
        raise SceneError(
            f"no Dask scheduler answers at '{scheduler}' ({why}); start one with `dask scheduler`, workers with"
            " `dask worker ADDRESS`, and give the address that it says, such as tcp://127.0.0.1:8786"
        ) from None
    if not client.scheduler_info()["workers"]:
        client.close()
        raise SceneError(f"the Dask scheduler at '{scheduler}' has no workers; start some: dask worker {scheduler}")
    return client


def work_on(scheduler: str, act: Callable[[Any], Any], tasks: Sequence[Any]) -> Generator[tuple[int, Any]]:
    """As `masonry.runtime.processes.work`, on a cluster. If a worker dies, another does its task, three times at most.

    Raises SceneError as `require`, and where the scheduler goes away.
    """
    client = _client(scheduler)
    from dask.distributed import as_completed

    try:
        begun = time.perf_counter()
        futures = {client.submit(one_at_a_time, act, task, pure=False): n for n, task in enumerate(tasks)}
        for future in as_completed(futures, loop=client.loop):
            if future.status == "cancelled":
                raise SceneError(f"the Dask scheduler at '{scheduler}' is gone; what is done stays, start again")
            if future.status == "error":
                yield futures[future], Lost(f"{future.exception()}".partition("\n")[0], time.perf_counter() - begun)
            else:
                yield futures[future], future.result()
            future.release()
    finally:
        client.close()


def one_at_a_time(act: Callable[[Any], Any], task: Any) -> Any:
    """Do a task in a worker that may have several threads: gmsh and the compiler take one at a time."""
    with ALONE:
        return act(task)
