"""Observers of a run at its rows, by the names under which a checkpoint keeps them."""

from masonry.configuration.configuration import configuration_of
from masonry.model.large.row_sums import STRETCH
from masonry.model.model import Model
from masonry.monitors.collapse import Collapse, LargestDeformation
from masonry.monitors.collisions.collision import Collision
from masonry.monitors.collisions.pressed_patches import PressedPatches
from masonry.monitors.mode_2_area import LawArea
from masonry.monitors.observer import Observer
from masonry.monitors.openings import Openings
from masonry.monitors.reactions import WorkOfLoads
from masonry.monitors.recording import Recording
from masonry.monitors.settling import Moving, Settling
from masonry.monitors.shaking_watch import ShakingWatch
from masonry.monitors.slide import Slide
from masonry.monitors.stability import Swings


def observers_of(model: Model, recording: Recording) -> dict[str, Observer]:
    """All observers of a run but the watch; those that may end it first, as others see only rows that are kept."""
    driven, large = any(drive is not None for drive in model.drives), configuration_of(model).any_size
    moving = {} if driven or not model.scaled else {"moving": Moving(model)}
    swings = {} if driven or model.scaled or large else {"swings": Swings(model)}
    return {
        **(large_looks(model, recording) if large else small_limits(model, recording)),
        "settling": Settling(model),
        **moving,
        **swings,
        "law_area": LawArea(model),
        **({"shaking": ShakingWatch(recording.surroundings)} if recording.is_shaken else {}),
        "work_of_loads": WorkOfLoads(recording.surroundings),
    }


def large_looks(model: Model, recording: Recording) -> dict[str, Observer]:
    """Observers where blocks turn, fall and deform as far as they like; bonds alone keep place and area."""
    slide = {"slide": Slide(model, rollers=False)} if model.swept else {}
    deforms = {"deformation": LargestDeformation(STRETCH)} if any(body is not None for body in model.bodies[1:]) else {}
    collapse = Collapse(model, recording.weight_when_shaken)
    return {**slide, "collapse": collapse, **deforms, "pressed_patches": PressedPatches(model)}


def small_limits(model: Model, recording: Recording) -> dict[str, Observer]:
    """Observers that end a run, or raise a doubt, where contacts stay those of the undeformed shape."""
    return {
        "slide": Slide(model, recording.slip_limit),
        "collision": Collision(model, recording.sets),
        "openings": Openings(model),
    }
