"""The results of a short run that was left alone, to compare with."""

import pytest

from masonry.runtime.folder import RESULTS
from tests.faults.samples import run


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--kills", type=int, default=100, metavar="N", help="runs killed by the slow test of faults")


@pytest.fixture(scope="session")
def alone(tmp_path_factory):
    """Folder of the results of a run that nothing happened to."""
    folder = tmp_path_factory.mktemp("faults") / RESULTS
    assert run(folder, "--checkpoint-every", "never") == 0
    return folder
