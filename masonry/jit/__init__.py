"""Compilation: the cache of compiled steps, and the sources that its key depends on."""
