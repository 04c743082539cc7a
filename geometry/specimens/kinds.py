"""Kinds of parameters that the function of a specimen may ask of a scene: annotations, from which its table is made.

>>> def pier(height: Length, courses: Count = 8) -> Specimen: ...
"""

from typing import Annotated

Length = Annotated[float, "length"]
"""m, above 0."""
Position = Annotated[float, "position"]
"""m, of either sign."""
Area = Annotated[float, "area"]
"""m2, above 0."""
Angle = Annotated[float, "angle"]
"""rad, of either sign."""
Count = Annotated[int, "count"]
"""From 1 to 1000."""
Number = Annotated[float, "number"]
"""Any plain number."""
