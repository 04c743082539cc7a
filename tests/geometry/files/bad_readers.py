"""Readers that end as native code may end on a hostile file."""

import ctypes
import time


def crash(path):
    ctypes.string_at(0)


def eat(path):
    return bytearray(1 << 40)


def trip(path):
    raise ValueError("no such thing")


def loop(path):
    while True:
        pass


def sleep(path):
    time.sleep(60)
