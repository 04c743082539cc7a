"""`pytest tests/fuzz/test_kinds.py --inputs 10000`: a long campaign."""

import pytest


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--inputs", type=int, metavar="N", help="bad inputs over all kinds, others in each campaign")
