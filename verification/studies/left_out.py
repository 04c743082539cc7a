"""What each shipped scene leaves out, and so does not pay for; and what its step does contain."""

from collections.abc import Callable

from masonry import laboratory, scene
from verification.report import page

ORDER = 40


def chapter(tell: Callable[[str], None]) -> page.Chapter:
    """One table: sizes, what is compiled and what is not, for every packaged scene."""
    made = page.Chapter("What each scene leaves out")
    made.parts.append(
        page.paragraph(
            "The program compiles a step for each scene that holds only what this scene uses. What is listed as left "
            "out takes no time and no memory, and cannot influence the result."
        )
    )
    for name in scene.packaged():
        tell(f"left out: {name}")
        loaded = scene.load(name)
        found = laboratory.check(loaded)
        contacts = ", ".join(f"{count} {group}" for group, count in found["contacts"].items())
        made.parts += [
            page.heading(f"{name}: {loaded.title}"),
            page.paragraph(
                f"{found['blocks']} blocks, {found['contact_points']} contact points ({contacts}), "
                f"{found['freedoms']} freedoms, {found['steps']} steps of {found['time_step_s']:.3g} s."
            ),
            page.table(["in the step", "left out"], [[_lines(found["compiled"]), _lines(found["left_out"])]]),
        ]
        if found["warnings"]:
            made.parts.append(page.bullets(found["warnings"]))
    return made


def _lines(items: list[str]) -> page.Cell:
    return page.Cell("\n".join(items), "text")
