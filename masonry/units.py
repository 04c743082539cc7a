"""The units that a scene may name: exact factors to SI, and the powers of m, kg and s that they stand for.

>>> measure("kN/m^3")
UnitInSI(factor=Fraction(1000, 1), powers=(-2, 1, -2))
"""

import re
from fractions import Fraction
from functools import lru_cache
from typing import NamedTuple

from masonry.errors import closest


class UnitInSI(NamedTuple):
    """One of a unit in SI, and the powers of m, kg and s; angles have none."""

    factor: Fraction
    powers: tuple[int, int, int]


SYMBOL = r"[A-Za-zµμ°]+(?:_[A-Za-z]+)?"
_TERM = re.compile(rf"([*/ ]?)\s*({SYMBOL})(?:(?:\^|\*\*)?(-?[1-9]))?\s*")
_COMMON = ("m", "mm", "cm", "in", "s", "ms", "N", "kN", "MN", "Pa", "kPa", "MPa", "GPa", "kg", "g", "J", "deg", "rad")
_SUGGESTED = f"common units are {', '.join(_COMMON)}"
_TRAPS = {"mPa": "MPa (mega; mPa is a thousandth of a pascal)", "gPa": "GPa"}
_TEMPERATURES = ("K", "kelvin", "degC", "celsius", "degF", "fahrenheit")
_BASE = {"m": (1, 0, 0), "kg": (0, 1, 0), "s": (0, 0, 1), "rad": (0, 0, 0)}
_PI = "3.1415926535897932384626433832795028841971693993751"
_METRIC = {
    **{"meter metre": "1 m", "g gram": "0.001 kg", "sec second": "1 s"},
    **{"N newton": "1 kg m/s^2", "Pa pascal": "1 N/m^2", "J joule": "1 N m", "W watt": "1 J/s"},
    **{"l L liter litre": "0.001 m^3", "Hz hertz": "1 s^-1", "bar": "1e5 Pa", "radian": "1 rad", "dyn dyne": "1e-5 N"},
    **{"gf gram_force force_gram pond": "9.80665 g m/s^2", "cal calorie": "4.184 J"},
    **{"Gal galileo": "0.01 m/s^2", "erg": "1e-7 J", "Wh watt_hour watthour": "3600 J", "Ba barye": "0.1 Pa"},
}
"""Units that may have a prefix."""
_OTHERS = {
    **{"t tonne metric_ton": "1000 kg", "tf t_force force_t": "9.80665 t m/s^2"},
    **{"min minute": "60 s", "h hr hrs hour": "3600 s", "d day": "24 h", "week": "7 d", "a yr yrs year": "365.25 d"},
    **{
        "month": "30.4375 d",
        "kgf kilogram_force force_kilogram": "9.80665 N",
        "ha hectare": "1e4 m^2",
        "are": "100 m^2",
    },
    **{"micron µ μ": "1e-6 m", "angstrom": "1e-10 m", "cc cubic_centimeter": "1e-6 m^3", "stere": "1 m^3"},
    **{"at technical_atmosphere": "98066.5 Pa", "atm atmosphere standard_atmosphere": "101325 Pa"},
    **{"torr": f"{Fraction(20265, 152)} Pa", "g_n gravity standard_gravity": "9.80665 m/s^2", "kayser": "100 m^-1"},
    **{"deg degree arcdeg arcdegree angular_degree": f"{Fraction(_PI) / 180} rad", "percent": "0.01 rad"},
    **{"arcmin arcminute arc_minute angular_minute": f"{Fraction(1, 60)} deg", "sr steradian": "1 rad"},
    **{"arcsec arcsecond arc_second angular_second": f"{Fraction(1, 3600)} deg", "ppm": "1e-6 rad"},
    **{"turn revolution cycle circle": f"{2 * Fraction(_PI)} rad", "gon grad grade gradian": "0.9 deg"},
    **{"rpm revolutions_per_minute": "1 turn/min", "rps revolutions_per_second": "1 turn/s"},
    **{"in inch inches international_inch international_inches": "25.4 mm", "thou th mil_length": "0.001 in"},
    **{"ft foot feet international_foot international_feet": "12 in", "yd yds yard international_yard": "3 ft"},
    **{"mi mile international_mile": "5280 ft", "nmi nautical_mile": "1852 m", "hand": "4 in"},
    **{"sft survey_foot": f"{Fraction(1200, 3937)} m", "smi survey_mile": "5280 sft", "chain": "66 sft"},
    **{"rd rod perch pole": "16.5 sft", "li link survey_link": "0.66 sft", "fathom": "6 sft", "fur furlong": "660 sft"},
    **{"acre": "43560 sft^2", "sq_in square_inch square_inches": "1 in^2", "sq_ft square_foot square_feet": "1 ft^2"},
    **{"sq_yd square_yard": "1 yd^2", "cu_in cubic_inch": "1 in^3", "cu_ft cubic_foot cubic_feet": "1 ft^3"},
    **{
        "cu_yd cubic_yard": "1 yd^3",
        "gal gallon liquid_gallon": "231 in^3",
        "imperial_gal imperial_gallon": "4.54609 l",
    },
    **{"lb lbs pound avdp_pound avoirdupois_pound": "0.45359237 kg", "oz ounce avdp_ounce": "0.0625 lb"},
    **{"gr grain": f"{Fraction(1, 7000)} lb", "slug": "1 lbf s^2/ft", "slinch blob slugette": "1 lbf s^2/in"},
    **{"stone": "14 lb", "cwt hundredweight short_hundredweight": "100 lb", "long_hundredweight UK_cwt": "112 lb"},
    **{"ton short_ton US_ton": "2000 lb", "long_ton UK_ton": "2240 lb", "pdl poundal": "1 lb ft/s^2"},
    **{"lbf pound_force force_pound": "9.80665 lb m/s^2", "ozf ounce_force force_ounce": "0.0625 lbf"},
    **{"kip": "1000 lbf", "ton_force force_ton": "2000 lbf", "psi": "1 lbf/in^2", "ksi": "1 kip/in^2"},
    **{
        "ft_lb foot_pound footpound": "1 ft lbf",
        "BTU Btu british_thermal_unit": "1055.056 J",
        "cal calorie": "4.184 J",
    },
    **{"mph MPH mile_per_hour": "1 mi/h", "kph KPH kilometer_per_hour": "1 km/h", "fps foot_per_second": "1 ft/s"},
    **{"mps meter_per_second": "1 m/s", "kps kilometer_per_second": "1 km/s", "kn kt knot": "1 nmi/h"},
}
_PREFIXES = {
    **{"p pico": "1e-12", "n nano": "1e-9", "µ μ u micro": "1e-6", "m milli": "1e-3", "c centi": "1e-2"},
    **{"d deci": "0.1", "da deca": "10", "h hecto": "100", "k kilo": "1e3", "M mega": "1e6", "G giga": "1e9"},
    **{"T tera": "1e12", "P peta": "1e15"},
}
_DEFINED = {name: text for names, text in (_METRIC | _OTHERS).items() for name in names.split()}
_PREFIXED = {"m", "s", "rad", "psi", "lbf", *(name for names in _METRIC for name in names.split())}
_TIMES = {name: Fraction(text) for names, text in _PREFIXES.items() for name in names.split()}


@lru_cache(maxsize=256)
def measure(text: str) -> UnitInSI:
    """Of a product such as "N/mm^2". Raises ValueError with the nearest unit for a name that is none."""
    factor, powers = Fraction(1), [0, 0, 0]
    for operator, symbol, power in _TERM.findall(text):
        one = _named(symbol)
        times = int(power or 1) * (-1 if operator == "/" else 1)
        factor *= one.factor**times
        powers = [total + times * n for total, n in zip(powers, one.powers, strict=True)]
    return UnitInSI(factor, (powers[0], powers[1], powers[2]))


@lru_cache(maxsize=256)
def _named(symbol: str) -> UnitInSI:
    """One unit by its name, with a prefix or without, in the plural or not."""
    if symbol in _TRAPS:
        raise ValueError(f"{symbol} is not accepted; did you mean {_TRAPS[symbol]}?")
    for name in (symbol, symbol.removesuffix("s")):
        if name != symbol and len(name) < 3:
            break
        if name in _BASE:
            return UnitInSI(Fraction(1), _BASE[name])
        if name in _DEFINED:
            number, _, product = _DEFINED[name].partition(" ")
            return _times(Fraction(number), measure(product))
        for prefix, factor in _TIMES.items():
            rest = name.removeprefix(prefix)
            if rest != name and rest in _PREFIXED and (name == symbol or len(rest) > 2):
                return _times(factor, _named(rest))
    if symbol in _TEMPERATURES:
        raise ValueError(f"{symbol!r} has no place in a scene; {_SUGGESTED}")
    same = next((unit for unit in _COMMON if unit.lower() == symbol.lower()), None)
    alike = same or closest(symbol[:20], _COMMON, 0.5)
    nearest = f"did you mean '{alike}'?" if alike else _SUGGESTED
    raise ValueError(f"{symbol[:80]!r} is no known unit; {nearest}")


def _times(factor: Fraction, one: UnitInSI) -> UnitInSI:
    return UnitInSI(factor * one.factor, one.powers)
