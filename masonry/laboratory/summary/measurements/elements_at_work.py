"""What elements bore at any step of a run, and how they are at its end."""

from masonry.assembly.assemble import Assembly
from masonry.results.records.element_record import WithElements


def elements_at_work(assembly: Assembly) -> WithElements:
    """The numbers of each element under its name."""
    each = ((element.name, element.record()) for element in assembly.model.elements)
    return WithElements.read({name: numbers for name, numbers in each if numbers is not None})
