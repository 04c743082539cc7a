"""Commands of `masonry`, each from its words to calls of the laboratory; returns the exit code."""

import argparse

from masonry.errors import SceneError, visible
from masonry.runtime.shell import OK, tell


def run_scene(words: argparse.Namespace) -> int:
    """`masonry run`."""
    if words.error_bar:
        from masonry.cli.error_bar_words import run_with_bar

        return run_with_bar(words)
    if words.workers is not None:
        raise SceneError("--workers: processes of the refinements of --error-bar; a run itself has --threads")
    from masonry.laboratory.run_command import run

    return run(words)


def resume_run(words: argparse.Namespace) -> int:
    """`masonry resume`."""
    from masonry.cli.error_bar_words import resume_with_bar
    from masonry.laboratory.run_command import resume
    from masonry.sweeps.error_bars.run_with_bar import is_begun

    return resume_with_bar(words) if is_begun(words.folder) else resume(words)


def check_scene(words: argparse.Namespace) -> int:
    """`masonry check`."""
    from masonry import scene
    from masonry.laboratory.text import check_text
    from masonry.sweeps.error_bars.check_line import checked

    print(check_text(checked(scene.load(words.scene, words.overrides))))
    return OK


def export_scene(words: argparse.Namespace) -> int:
    """`masonry export`: with tets where the scene has them."""
    from masonry import scene
    from masonry.shell_functions import write_export

    blocks = write_export(scene.load(words.scene, words.overrides), words.to, words.overwrite)
    print(visible(f"{words.to}: {blocks} blocks"))
    return OK


def import_blocks(words: argparse.Namespace) -> int:
    """`masonry import`: a scene and a file of blocks, and a table of what was found."""
    from masonry.importing.import_words import OTHERS, QUANTITIES, settings_of
    from masonry.importing.importing import import_file

    options = {word: getattr(words, word) for word in (*QUANTITIES, *OTHERS)}
    print(import_file(words.file, words.out, settings_of(options, "--"), words.overwrite, tell))
    return OK


def list_scenes(words: argparse.Namespace) -> int:
    """`masonry list`: name and title of every packaged scene."""
    from masonry.runtime.tables import columns
    from masonry.scene.source import titles

    print("\n".join(columns(list(titles().items()))))
    return OK


def show_scene(words: argparse.Namespace) -> int:
    """`masonry show`: the text of a scene as its file has it; which scene it stands on is said beside it."""
    from masonry.scene.source import read

    source = read(words.scene)
    print(source.text, end="" if source.text.endswith("\n") else "\n")
    if source.base is not None:
        tell(f"masonry: what it does not say is of its base: masonry show {source.base.stem}")
    return OK


def plot_results(words: argparse.Namespace) -> int:
    """`masonry plot`: curve.png and cracks.png again, or as PDF or SVG, from summary.json and history.h5."""
    from masonry.laboratory.result import load_result
    from masonry.laboratory.text import paths_text
    from masonry.runtime.folder import writing

    result = load_result(words.folder)
    with writing(words.folder, "pictures"):
        paths = result.save_pictures(words.folder, words.format)
    print(paths_text(paths))
    return OK


def doctor(words: argparse.Namespace) -> int:
    """`masonry doctor`: 0 if all is fine, 1 if something is missing or wrong."""
    from masonry.cli.doctor import diagnose, warm

    if words.warm:
        warm(lambda line: print(line, flush=True))
        return OK
    return OK if diagnose(words.quick, lambda line: print(line, flush=True)) else 1
