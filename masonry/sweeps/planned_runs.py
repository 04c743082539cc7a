"""The runs of a sweep: each point's values worked out against its scene, and the scene loaded, before anything runs."""

import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from masonry.errors import Faults, SceneError, nearest, visible
from masonry.runtime.tables import columns
from masonry.sweeps.job import Job
from masonry.sweeps.points import points, si
from masonry.sweeps.read import Sweep, Times

MOST = 5
"""Things that are wrong which one message tells."""
RECORD = re.compile(r"(ground\.(\d+\.)?|quiet\.\d+\.wave\.)record|curve\.measured|specimen\.path")
"""Keys whose value is a file."""


@dataclass(frozen=True)
class Planned:
    """One run of a sweep: its job, and what the sweep sets in it.

    values  dotted key -> value as the scene takes it
    times   dotted key -> factor, of the keys that were told relative to another value
    """

    job: Job
    values: dict[str, Any]
    times: dict[str, float]


def plan(sweep: Sweep) -> list[Planned]:
    """Every run of a sweep, in order. Raises SceneError for those that the scene does not take: a line for each thing
    that is wrong says in which run, the key, what is wrong and what is allowed.
    """
    table = points(sweep)
    base = _Base(sweep)
    for point in table[:1] + [row for row in table if set(row) != set(table[0])]:
        base.check_groups(point)
    runs: list[Planned] = []
    wrong: dict[int, SceneError] = {}
    for number, point in enumerate(table):
        try:
            runs.append(base.planned(point))
        except SceneError as error:
            wrong[number] = error
    if wrong:
        raise faults(sweep.name, wrong, len(table))
    return runs


def faults(name: str, wrong: Mapping[int, SceneError], count: int, more: str = "") -> SceneError:
    """Errors of some of `count` runs, by their number from 0: a line for each thing, with the first run that has it,
    and at last `more`."""
    by_words: dict[str, list[int]] = {}
    for number, error in wrong.items():
        by_words.setdefault("\n".join(line.removeprefix("--set ") for line in error.lines), []).append(number)
    lines = []
    for words, numbers in list(by_words.items())[:MOST]:
        others = f" and {len(numbers) - 1} more" if len(numbers) > 1 else ""
        run = f", run {numbers[0] + 1} of {count}{others}" if count > 1 else ""
        lines += [f"{name}{run}: {words}".split("\n")[0], *words.split("\n")[1:]]
    lines += [f"... and {len(by_words) - MOST} more"] if len(by_words) > MOST else []
    lines += [more] if more else []
    return Faults(lines) if len(lines) > 1 else SceneError(*lines)


def listing(planned: Sequence[Planned]) -> str:
    """A line a run: its number and what the sweep sets in it; strengths that are cut as the law takes them."""

    def words(run: Planned, key: str, value: Any) -> str:
        strength = run.job.tensile_strengths.get(key)
        used = f" ({strength.of_law:.4g} Pa used)" if strength is not None and strength.is_cut else ""
        return f"{key} = {value!r:.60}{used}"

    rows = (visible("  ".join(words(run, *pair) for pair in run.values.items())) for run in planned)
    return "\n".join(columns([(str(number), row) for number, row in enumerate(rows, start=1)], right=[0]))


class _Base:
    """The scene that all runs begin with."""

    def __init__(self, sweep: Sweep) -> None:
        self.sweep = sweep
        self.fixed = {key: value for key, value in sweep.settings.items() if not isinstance(value, Times)}
        self.relative = {key: value for key, value in sweep.settings.items() if isinstance(value, Times)}
        self.raw = tomllib.loads(Job(sweep.scene).resolved)
        self.scene: dict[str, Any] | None = None

    def check_groups(self, point: Mapping[str, Any]) -> None:
        """A misspelt group would be a new one, without any effect."""
        for key in (*self.sweep.settings, *point):
            table, _, rest = key.partition(".")
            known = list(self.raw.get("material" if table == "kinematics" else table, {}))
            group = rest.partition(".")[0].strip("\"'")
            if table in ("contact", "material", "kinematics") and rest and group not in (*known, "default"):
                raise SceneError(f"{self.sweep.name}: {key}: no group '{group}' in this scene; {nearest(group, known)}")

    def planned(self, point: Mapping[str, Any]) -> Planned:
        settings = self.relative | dict(point)
        plain = {key: value for key, value in settings.items() if not isinstance(value, Times)}
        of_itself = {k: v for k, v in settings.items() if isinstance(v, Times) and v.of in (None, k)}
        of_another = {k: v for k, v in settings.items() if isinstance(v, Times) and v.of not in (None, k)}
        if of_itself:
            if self.scene is None:
                self.scene = tomllib.loads(Job(self.sweep.scene, self.fixed).resolved)
            plain |= {key: _scaled(self.scene, key, key, value.factor) for key, value in of_itself.items()}
        if of_another:
            known = self.fixed | plain
            for key, value in of_another.items():
                assert value.of is not None
                if value.of in of_another:
                    raise SceneError(f"{key}: of {value.of}, which itself follows another key; name that key")
                here = known if value.of in known else tomllib.loads(Job(self.sweep.scene, known).resolved)
                plain[key] = _scaled(here, key, value.of, value.factor)
        values = {key: plain[key] for key in settings}
        job = Job(self.sweep.scene, _beside(self.fixed | values, self.sweep.folder))
        job.key()
        return Planned(job, values, {k: v.factor for k, v in settings.items() if isinstance(v, Times)})


def _beside(settings: dict[str, Any], folder: Path) -> dict[str, Any]:
    """The settings with records of the ground looked for beside the sweep file, where a run elsewhere finds them."""
    is_path = {key: RECORD.fullmatch(key) is not None and isinstance(value, str) for key, value in settings.items()}
    return {key: str(folder / value) if is_path[key] else value for key, value in settings.items()}


def _scaled(scene: dict[str, Any], key: str, of: str, factor: float) -> Any:
    """`factor` times the value that the scene has at the dotted key `of`, with its unit."""
    value, unit = si(_at(scene, key, of), f"{key}: times {factor:g}: {of}")
    return f"{factor * value!r} {unit}" if unit else factor * value


def _at(scene: dict[str, Any], key: str, of: str) -> Any:
    """The value at a dotted key of a scene, or of settings, which have it as it is written."""
    from masonry.scene.lines import split_key

    if of in scene:
        return scene[of]
    at: Any = scene
    parts = split_key(of)
    for n, part in enumerate(parts, start=1):
        if isinstance(at, list) and part.isdecimal() and len(part) < 9 and int(part) < len(at):
            at = at[int(part)]
        elif isinstance(at, dict) and part in at:
            at = at[part]
        else:
            fits = _is_number if n == len(parts) else _is_table
            known = [name for name, value in at.items() if fits(value)] if isinstance(at, dict) else ()
            raise SceneError(f"{key}: {of} is not in the scene, nothing to multiply; {nearest(part, known)}")
    return at


def _is_table(value: Any) -> bool:
    return isinstance(value, dict | list)


def _is_number(value: Any) -> bool:
    """Whether it is a number or a quantity."""
    try:
        si(value, "")
    except SceneError:
        return False
    return True
