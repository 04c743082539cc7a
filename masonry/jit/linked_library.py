"""Functions that are compiled into other functions alone: they are linked there, and have no machine code of their own.

Numba makes machine code of each function that it compiles, and passes over it all that it calls, as if Python called
it. What `masonry.jit.compiler.inner` decorates nobody calls but compiled code, into which LLVM links it whole.
"""

from typing import Any

from llvmlite import binding
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase, DefaultPassBuilder


class LinkedLibrary(JITCodeLibrary):
    """The intermediate code of a function, for others to link."""

    _final_module: Any

    def _optimize_final_module(self) -> None:
        """The library that links it does that."""

    def _optimize_functions(self, ll_module: Any) -> None:
        ll_module.data_layout = self._codegen._data_layout

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()
        for function in self._final_module.functions:
            if not function.is_declaration and function.linkage == binding.Linkage.external:
                function.linkage = "linkonce_odr"  # as Numba has it: several modules may hold it, or inline it
        self._packed = PackedModule(self._final_module.as_bitcode())
        self._final_module = None
        self._finalized = True

    def _get_module_for_linking(self) -> "PackedModule":
        self._ensure_finalized()
        return self._packed

    def get_pointer_to_function(self, name: str) -> int:
        """0, as Numba says where there is none."""
        self._ensure_finalized()
        return 0

    @property
    def codegen(self) -> Any:
        """Object that tells Numba where the function's environment lies: nowhere, as nothing was loaded."""
        return _NoEnvironment


class PackedModule:
    """A module of LLVM as bytes, of which a copy is unpacked each time that it is linked: as modules the functions of a
    step, each with all that it calls, took 400 MB."""

    def __init__(self, bitcode: bytes) -> None:
        self.bitcode = bitcode

    def clone(self) -> binding.ModuleRef:
        """Module that Numba links, and so destroys."""
        return binding.parse_bitcode(self.bitcode)


class _NoEnvironment:
    @staticmethod
    def set_env(name: str, environment: Any) -> None:
        pass


class LinkedCompiler(CompilerBase):
    """Numba's pipeline, with such a library."""

    def define_pipelines(self) -> list[Any]:
        state = self.state
        state.library = LinkedLibrary(state.targetctx.codegen(), state.func_id.func_qualname)
        return [DefaultPassBuilder.define_nopython_pipeline(state)]
