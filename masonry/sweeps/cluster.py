"""Tasks done elsewhere: by the workers of a Dask cluster that somebody started, or by an executor of the user's."""

import logging
import threading
import time
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import BrokenExecutor, CancelledError, as_completed
from typing import Any

from masonry.errors import SceneError, extra
from masonry.runtime.processes import Lost

PATIENCE = 5.0
"""Seconds for a scheduler to answer."""
ALONE = threading.Lock()


def require(executor: Any) -> None:
    """Raise SceneError where what a user hands over does no runs: Dask is not installed, no scheduler answers, or it
    has no workers."""
    if isinstance(executor, str):
        _client(executor).close()
    elif not callable(getattr(executor, "submit", None)):
        raise SceneError(
            f"executor = {executor!r:.60}: give a Dask client, the address of its scheduler, or an executor of "
            "concurrent.futures"
        )


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


def work_on(executor: Any, act: Callable[[Any], Any], tasks: Sequence[Any]) -> Generator[tuple[int, Any]]:
    """As `masonry.runtime.processes.work`, elsewhere.

    executor  the address of a Dask scheduler, a Dask client, or an executor of concurrent.futures
    If a worker of a cluster dies, another does its task, three times at most. Raises SceneError as `require`, and where
    the scheduler or the executor goes away.
    """
    if not isinstance(executor, str):
        require(executor)
        yield from (_by_client if hasattr(executor, "scheduler_info") else _by_executor)(executor, act, tasks)
        return
    client = _client(executor)
    try:
        yield from _by_client(client, act, tasks)
    finally:
        client.close()


def _by_client(client: Any, act: Callable[[Any], Any], tasks: Sequence[Any]) -> Generator[tuple[int, Any]]:
    from dask.distributed import as_completed

    begun = time.perf_counter()
    futures = {client.submit(one_at_a_time, act, task, pure=False): n for n, task in enumerate(tasks)}
    try:
        for future in as_completed(futures, loop=client.loop):
            if future.status == "cancelled":
                raise SceneError("the Dask scheduler is gone; what is done stays, start again")
            if future.status == "error":
                yield futures[future], Lost(f"{future.exception()}".partition("\n")[0], time.perf_counter() - begun)
            else:
                yield futures[future], future.result()
            future.release()
    finally:
        for future in futures:
            future.release()


def _by_executor(executor: Any, act: Callable[[Any], Any], tasks: Sequence[Any]) -> Generator[tuple[int, Any]]:
    begun = time.perf_counter()
    futures: dict[Any, int] = {}
    try:
        for number, task in enumerate(tasks):
            futures[executor.submit(one_at_a_time, act, task)] = number
        for future in as_completed(futures):
            error = future.exception()
            if isinstance(error, BrokenExecutor):
                raise error
            lost = None if error is None else Lost(f"{type(error).__name__}: {error}", time.perf_counter() - begun)
            yield futures[future], future.result() if lost is None else lost
    except (BrokenExecutor, CancelledError, RuntimeError) as error:
        why = str(error).partition("\n")[0] or type(error).__name__
        raise SceneError(f"the executor does nothing more ({why}); what is done stays, start again") from None
    finally:
        for future in futures:
            future.cancel()


def one_at_a_time(act: Callable[[Any], Any], task: Any) -> Any:
    """Do a task in a worker that may have several threads: gmsh and the compiler take one at a time."""
    with ALONE:
        return act(task)
