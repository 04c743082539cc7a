"""Are contacts pressed by more than their strength in compression, though the run has them bear it?

Asked where `compressive_strength` is named and `crushing` is not. The strength itself is the limit: beyond it the joint
or the unit would crush, and all that follows is another story.
"""

from masonry.judgement.doubt import Criterion

COMPRESSION = Criterion(
    name="compression",
    measure=lambda evidence: evidence.number("compression_over_strength"),
    limit=1.0,
    sentence="contacts bear up to {value:.3g} times their compressive strength, as crushing is not modelled",
    advice='model it: crushing = "cut-off", or "cap" with a fracture_energy_compression and a closing_at_peak',
    asked_of=lambda evidence: evidence.summary.get("compression_over_strength") is not None,
)
