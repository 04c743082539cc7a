"""Motions imposed in real time, in a line each: the largest speed and the largest acceleration."""

from masonry.assembly.assemble import Assembly
from masonry.ground.ground_motion import Motion
from masonry.laboratory.summary.moved_drive import moved_drive
from masonry.rows.columns import GRAVITY


def moved_lines(assembly: Assembly) -> list[str]:
    """Of the ground, component by component, and of a drive."""
    lines = []
    for ground in assembly.scene.ground:
        name = "ground" if ground.on is None else f"ground of {ground.on}"
        lines += [f"{name} along {axis}: {_motion_text(motion)}" for axis, motion in ground.motions.items()]
    scene = assembly.scene
    if scene.ground and scene.is_large and scene.gravity is not None and scene.floor is None:
        lines.append("no [floor]: what falls off its supports goes on falling")
    if (drive := moved_drive(assembly)) is not None:
        peaks = _peaks(drive.peak_acceleration_m_s2, drive.peak_velocity_m_s)
        lines.append(f"drive: at most {peaks}")
    return lines


def _motion_text(motion: Motion) -> str:
    text = f"at most {_peaks(motion.peak_acceleration, motion.peak_velocity)} and {_mm(motion.peak_displacement)}"
    left = motion.residual_velocity, motion.residual_displacement
    if abs(left[0]) <= 1e-6 * motion.peak_velocity and abs(left[1]) <= 1e-6 * motion.peak_displacement:
        return f"{text} in {motion.duration:.4g} s, at whose end nothing is left"
    return (
        f"{text} in {motion.duration:.4g} s, at whose end {left[0]:.3g} m/s and {_mm(left[1])} are left "
        "(baseline = 'linear' takes them off)"
    )


def _peaks(acceleration: float, velocity: float) -> str:
    return f"{acceleration:.4g} m/s2 ({acceleration / GRAVITY:.3g} g), {velocity:.4g} m/s"


def _mm(length: float) -> str:
    return f"{1e3 * length:.4g} mm"
