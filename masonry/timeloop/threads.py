"""How many threads a run is worth, where that is left to the program."""

from masonry.configuration.configuration import configuration_of
from masonry.model.model import Model
from masonry.runtime.processors import AUTO, free_processors

WORTH = 7000
"""Contact points and tets for each thread: of fewer, a step is over before threads have met."""


def threads_for(model: Model, wish: int | str) -> int:
    """The wish, or for AUTO as many as the size of the model is worth and as processors have nothing else to do: a step
    waits for the last of its threads. Steps of large displacement are taken by one."""
    if wish != AUTO:
        return int(wish)
    if configuration_of(model).any_size:
        return 1
    mesh = model.layout.mesh
    size = len(model.group) + (0 if mesh is None else len(mesh.tets))
    return max(1, min(free_processors(), size // WORTH))
