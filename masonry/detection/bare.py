"""Compilation for functions of numbers and arrays that make no arrays: without counting who holds an array.

Numba counts each array that is handed to a function which it does not inline, by steps that no other thread may cut
into: a pair of boxes takes half as long again with that. What is compiled so may read and write arrays and views of
them, but not make, return or keep one.
"""

from masonry.jit.compiler import STEP, _kept

bare = _kept(STEP, _nrt=False)
inlined = _kept(STEP, _nrt=False, forceinline=True)
"""The same for what is called in one place: an array is handed over as nine numbers, which costs as much as the work
of a small function."""
