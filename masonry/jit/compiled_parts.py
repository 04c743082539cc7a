"""Parts: functions of one record that are compiled for themselves, once for all scenes that need them.

A step is a list of them (`StepCalls`), which one small driver calls in turn, by their addresses: what is compiled for
a law, a kind of bodies or an observer serves every scene that has it.
"""

import hashlib
from collections.abc import Callable, Sequence
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np

from masonry.jit.compiler import is_kept, jit, once, part
from masonry.jit.records import ArgumentRecord, RecordKind, call, kind_of
from masonry.jit.workers import compile_all


class CompiledPart:
    """A function of one record. What it is compiled to depends on the type of the record alone."""

    def __init__(self, function: Callable[[Any], None]) -> None:
        self.module, self.name, self.compiled = function.__module__, function.__name__, part(function)

    def of(self, *arguments: Any) -> "Call":
        """A call of it with these arguments; nothing is compiled yet."""
        return Call(self, arguments)

    def stamp(self, kind: RecordKind) -> str:
        """The name of what it is compiled to for a kind of record, on such a processor."""
        processor = self.compiled.targetctx.codegen().magic_tuple()
        return hashlib.sha256(f"{self.module} {self.name} {kind} {processor}".encode()).hexdigest()[:16]

    def is_compiled(self, kind: RecordKind) -> bool:
        """Whether it need not be compiled for a kind of record, but loaded from the cache at most."""
        return (kind,) in self.compiled.overloads or is_kept(self.stamp(kind))

    def compile(self, kind: RecordKind) -> None:
        """Compile it for a kind of record, or load it from the cache, the first time."""
        if (kind,) not in self.compiled.overloads:
            with once(self.stamp(kind)):
                self.compiled.compile((kind,))

    def address(self, kind: RecordKind) -> int:
        """Where its machine code for a kind of record stands."""
        self.compile(kind)
        result = self.compiled.overloads[(kind,)]
        return int(result.library.get_pointer_to_function(result.fndesc.llvm_func_name))


class Call:
    """A part and its arguments, of which some may be calls that it makes: it finds their two addresses in its record.

    Numbers among the arguments are those of now, arrays are shared.
    """

    def __init__(self, part: CompiledPart, arguments: tuple[Any, ...]) -> None:
        self.part, self.arguments = part, arguments

    @property
    def nested(self) -> list["Call"]:
        """The calls that it makes, each after those that it makes itself."""
        calls = [call for call in self.arguments if isinstance(call, Call)]
        return [inner for call in calls for inner in (*call.nested, call)]

    @cached_property
    def kind(self) -> RecordKind:
        return kind_of(*((0, 0) if isinstance(argument, Call) else argument for argument in self.arguments))

    @property
    def is_compiled(self) -> bool:
        """Whether its own part need not be compiled, but loaded from the cache at most."""
        return self.part.is_compiled(self.kind)

    @cached_property
    def addresses(self) -> tuple[int, int]:
        """Of the machine code and of the record; compiles what is not compiled yet."""
        values = (argument.addresses if isinstance(argument, Call) else argument for argument in self.arguments)
        self.record = ArgumentRecord(self.kind, tuple(values))
        return self.part.address(self.kind), self.record.address

    def replace(self, old: Any, new: Any) -> None:
        """Another value of the same kind in place of an argument, where it is one; the addresses stay."""
        for k, argument in enumerate(self.arguments):
            if argument is old:
                self.arguments = (*self.arguments[:k], new, *self.arguments[k + 1 :])
                self.record.put(k, new)

    def __call__(self) -> None:
        """Make the call, from Python."""
        make(*self.addresses)


class RepeatedCall:
    """A part that is called now and then, from Python, mostly with the same arguments: the call is put together anew
    where one of them is another object."""

    def __init__(self, part: CompiledPart) -> None:
        self.part, self.made = part, part.of()

    def of(self, *arguments: Any) -> Call:
        """The call with these arguments."""
        before = self.made.arguments
        if len(before) != len(arguments) or any(old is not new for old, new in zip(before, arguments, strict=True)):
            self.made = self.part.of(*arguments)
        return self.made


@jit
def make(function, record):
    """Make a call by its addresses."""
    call(function, record)


class StepCalls:
    """Calls one after the other, in sections: (K, 2) addresses of parts and records, and bounds of the sections."""

    def __init__(self, *sections: Sequence[Call]) -> None:
        self.calls = [call for section in sections for call in section]
        self.bounds = np.cumsum([0, *map(len, sections)])
        self.of_rows: list[Call] = []

    def followed_by(self, calls: Sequence[Call]) -> "StepCalls":
        """With more calls at the end of the last section."""
        *sections, last = (self.calls[a:b] for a, b in pairwise(self.bounds))
        return StepCalls(*sections, [*last, *calls]) if calls else self

    def around(self, first: Sequence[Call], last: Sequence[Call]) -> "StepCalls":
        """With more calls with which a step begins, and more at its end."""
        once, begins, *sections = (self.calls[a:b] for a, b in pairwise(self.bounds))
        return StepCalls(once, [*first, *begins], *sections).followed_by(last)

    @property
    def is_compiled(self) -> bool:
        return all(call.is_compiled for call in self.all_calls)

    @property
    def all_calls(self) -> list[Call]:
        """Its calls and those that they make; and what rows call, which is compiled beside them."""
        return [*(inner for call in self.calls for inner in (*call.nested, call)), *self.of_rows]

    def addresses(self) -> np.ndarray:
        """(K, 2); compiles what is not compiled yet."""
        compile_all([(call.part, call.kind) for call in self.all_calls])
        return np.array([call.addresses for call in self.calls], dtype=np.int64).reshape(-1, 2)
