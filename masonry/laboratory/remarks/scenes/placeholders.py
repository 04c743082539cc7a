"""Has the user replaced what an import made up? Such a value is nobody's, whatever comes of it."""

from masonry.assembly.assemble import Assembly
from masonry.judgement.doubt import Doubt
from masonry.scene.schema import INVENTED


def doubts(assembly: Assembly) -> list[Doubt]:
    """One, with all keys."""
    keys = [key for key, why in assembly.scene.assumptions.items() if why.startswith(INVENTED)]
    if not keys:
        return []
    sentence = f"these are placeholders that `masonry import` made up: {', '.join(keys)}"
    advice = "put in your own, and take their lines out of [assumptions]"
    return [Doubt("placeholders", None, None, sentence, advice)]
