"""What `masonry check` foretells beside what runs took: steps, and seconds of processor.

    .venv/bin/python -m verification.studies.forecasts [--results DIR] [SCENE ...]

Without names all scenes that are shipped, of which some take minutes. With --results nothing is run: summaries are read
from DIR/SCENE/summary.json, as `masonry run SCENE --out DIR/SCENE` writes them.
"""

import argparse
from pathlib import Path

from masonry.assembly.assemble import assemble
from masonry.errors import SceneError, Stopped
from masonry.laboratory import laboratory
from masonry.laboratory.cost import forecast
from masonry.results.summary import Summary
from masonry.runtime.text_files import json_of
from masonry.scene import Scene, load
from masonry.scene.source import titles

OWN = Path(__file__).parents[1] / "scenes"
"""Scenes of the verification, which are known by their names here as well."""
LOADED = 3.0
"""Seconds in which a step that was compiled before is there."""


def summary_of(scene: Scene) -> Summary:
    """Of a run that is made now, also of one that is stopped; where something was compiled, of the next one."""
    try:
        summary = laboratory.run(scene).summary
        return laboratory.run(scene).summary if (summary.seconds_compile or 0.0) > LOADED else summary
    except Stopped as stop:
        assert stop.result is not None
        return stop.result.summary


def line(name: str, results: Path | None) -> str:
    """A line of the table."""
    file = OWN / f"{name}.toml"
    scene = load(file if file.exists() else name)
    run = forecast(assemble(scene))
    summary = summary_of(scene) if results is None else Summary.read(json_of(results / name / "summary.json"))
    (steps, fewest, largest), (seconds, shortest, longest) = run.steps, run.seconds
    made, processor = summary.steps or 1, summary.seconds_processor_run
    row = f"{name:<30}{steps:>9}{fewest:>9}{largest:>9}{made:>9}{steps / made:7.2f}"
    row += f" {'in' if fewest <= made <= largest else 'OUT':>4}"
    if processor is None:
        return row
    within = "in" if shortest / 2 <= processor <= 2 * longest else "OUT"
    return f"{row}{seconds:10.2f}{shortest:10.2f}{longest:10.2f}{processor:10.2f}{seconds / processor:7.2f} {within:>4}"


def main() -> None:
    """The table."""
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("scenes", nargs="*", metavar="SCENE")
    words.add_argument("--results", type=Path, metavar="DIR")
    chosen = words.parse_args()
    print(f"{'scene':<30}{'steps':>9}{'least':>9}{'most':>9}{'made':>9}{'ratio':>7}     ", end="")
    print(f"{'seconds':>10}{'least':>10}{'most':>10}{'took':>10}{'ratio':>7}")
    for name in chosen.scenes or titles():
        try:
            print(line(name, chosen.results), flush=True)
        except SceneError as error:
            print(f"{name:<30}{error}")


if __name__ == "__main__":
    main()
