"""What the step of large displacement does around the patches, of a model whose bodies were moved by hand."""

from masonry.kernels.large_step import of_each_kind, patch_forces_on, places_of, velocities_of


def gather(model) -> None:
    """As the step does after it has placed the blocks."""
    large, motion = model.large, model.large.near.motion
    _make(of_each_kind(places_of, model.bodies, motion, large.members, large.bonds))
    _make(of_each_kind(velocities_of, model.bodies, motion, large.members))


def hand_over(model) -> None:
    """The forces of the patches to the bodies."""
    _make(of_each_kind(patch_forces_on, model.bodies, model.large.near.motion, model.large.members))


def _make(calls) -> None:
    for call in calls:
        call()
