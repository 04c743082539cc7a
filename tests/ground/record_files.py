"""One shock as files of many formats, written after their public descriptions: each with how a scene reads it."""

import struct
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

COUNT, STEP, G = 397, 0.005, 9.80665
_TIME = STEP * np.arange(COUNT)
SHOCK = 2.5 * np.exp(-2.0 * _TIME) * np.sin(9.0 * _TIME) - 0.7 * _TIME * np.sin(31.0 * _TIME + 0.4) + 0.05
"""(n,) m/s2: unsymmetric, with an offset, neither at rest at its start nor at its end; no multiple of 5 or 8."""
IN_G, GAL = SHOCK / G, 100.0 * SHOCK


class Written(NamedTuple):
    """A file, keys with which a scene reads it, what is read (SI), and how exactly the format prints it (m/s2)."""

    name: str
    text: str | bytes
    keys: dict[str, str]
    right: np.ndarray = SHOCK
    digit: float = 1e-4


def lines_of(values: np.ndarray, form: str, a_line: int) -> str:
    """So many numbers a line."""
    rows = [values[k : k + a_line] for k in range(0, len(values), a_line)]
    return "\n".join("".join(form % one for one in row) for row in rows) + "\n"


def table(names: str, separator: str, point: str = ".", more: int = 0, digits: int = 6) -> str:
    """Times and accelerations (g), and more columns of other motions."""
    others = [0.3 * np.roll(IN_G, 40 * (k + 1)) for k in range(more)]
    rows = [
        separator.join([f"{t:.3f}", *(f"{one[k]:.{digits}f}" for one in (IN_G, *others))]).replace(".", point)
        for k, t in enumerate(_TIME)
    ]
    return names + "\n".join(rows) + "\n"


def tables() -> Iterator[Written]:
    """With a column of times."""
    named = {"x": "East"}
    yield Written("comma.csv", table("time (s),East (g)\n", ","), named)
    yield Written("title.csv", table("# Kobe, Japan 1995\n# Time (s),East (g)\n", ","), named)
    yield Written(
        "three.csv", table("A town, its square, 1999, 17 August\nTime,East [g],Up [g],N [g]\n", ",", more=2), named
    )
    yield Written("units.csv", table("Time,East,North\n(s),(g),(g)\n", ",", more=1), named)
    yield Written("mark.csv", b"\xef\xbb\xbf" + table("time (s),East (g)\n", ",").replace("\n", "\r\n").encode(), named)
    yield Written("decimal.csv", table("Zeit (s);East (g)\n", ";", ","), named)
    yield Written("quoted.csv", table('"time (s)";"East (g)";\n', ";").replace("\n0.1", '\n"0.100"', 0), named)
    yield Written("tabs.txt", table("t\tEast\n", "\t"), named | {"unit": "g"})
    yield Written("blanks.txt", table("A town, 1995\ntime (s)  East (g)  Up (g)  North (g)\n", "   ", more=2), named)
    yield Written("alone.txt", table("", " "), {"x": "2", "unit": "g"})
    yield Written("head.txt", table("DT = 0.005 s, number of samples: 397\n", "  "), {"x": "2", "unit": "g"})


def numbers_alone() -> Iterator[Written]:
    """Without times and names."""
    keys = {"x": "1", "unit": "g", "step": "0.005 s"}
    yield Written("one.txt", lines_of(IN_G, "%12.6f", 1), keys)
    yield Written("five.g3", lines_of(IN_G, "%16.7E", 5), keys)
    yield Written("eight.txt", lines_of(IN_G, "%10.6f", 8), keys)
    yield Written("three.txt", "A town, 17 August 1995\n" + lines_of(IN_G, "%10.6f", 3), keys)
    yield Written("whole.txt", lines_of(IN_G[:395], "%12.6f", 5), keys, SHOCK[:395])
    yield Written("commas.txt", lines_of(IN_G[:396], "%.6f, ", 4).replace(", \n", "\n"), keys, SHOCK[:396])
    heads = "Sampling rate: 200 Hz\nUnits: cm/s^2\nNumber of points: 397\n"
    yield Written("told.txt", heads + lines_of(GAL, "%12.4f", 1), {"x": "1"})
    yield Written("told-5.txt", heads + lines_of(GAL, "%12.4f", 5), {"x": "1"})


def of_peer() -> Iterator[Written]:
    """Numbers that go on from line to line below NPTS."""
    title = "PEER NGA STRONG MOTION DATABASE RECORD\nA town, 1/16/1995, 090\n"
    in_g = title + "ACCELERATION TIME SERIES IN UNITS OF G\n"
    numbers, keys = lines_of(IN_G, "%15.7E", 5), {"x": "1"}
    yield Written("new.AT2", in_g + "NPTS=    397, DT=   .0050 SEC\n" + numbers, keys)
    old = "ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.1 Hz LP=25.0 Hz\n"
    yield Written("old.AT2", title + old + "  397   0.0050   NPTS, DT\n" + numbers, keys)
    yield Written("turned.AT2", in_g + "DT= 0.005, NPTS= 397\n" + numbers, keys)
    yield Written("tstep.AT2", in_g + "NPTS = 397 , Tstep = 5.0D-03 sec\n" + numbers, keys)
    in_gal, gal = title + "ACCELERATION DATA IN UNITS OF CM/S2\n", lines_of(GAL, "%15.7E", 5)
    yield Written("cm-s2.AT2", in_gal + "NPTS=    397, DT=   .0050 SEC\n" + gal, keys)
    yield Written("cm-s-s.AT2", in_gal.replace("CM/S2", "(CM/S/S)") + "NPTS= 397, DT= 5 ms\n" + gal, keys)
    yield Written("sec.AT2", in_gal.replace("CM/S2", "cm/sec^2") + "NPTS= 397, DT= .005 SEC\n" + gal, keys)
    marks = "Own shock\n397 points at equal spacing of 0.005 sec\nThe units are (g)\n*** Begin data ***\n"
    marks += "NPTS= 397, DT= .005\n"
    yield Written("marks.AT2", marks + lines_of(IN_G, "%10.5f", 8) + "*** End Data ***\n\n", keys)
    full = lines_of(np.append(IN_G, np.zeros(3)), "%15.7E", 5)
    yield Written("filled.AT2", in_g + "NPTS=    397, DT=   .0050 SEC\n" + full, keys)
    exponents = numbers.replace("E", "D")
    yield Written("fortran.AT2", in_g + "NPTS= 397, DT= .50D-02 SEC\n" + exponents, keys)
    touching = lines_of(IN_G * 100.0, "%10.7f", 8)
    yield Written("8F10.7.AT2", "DT= .005 NPTS= 397\n" + touching, keys | {"unit": "g"}, 100.0 * SHOCK)
    velocity = title + "VELOCITY TIME SERIES IN UNITS OF CM/S\nNPTS= 397, DT= .005 SEC\n" + gal
    yield Written("own.VT2", velocity, keys | {"quantity": "velocity"})
    yield Written("advice.txt", "NPTS= 397, DT= 0.005 SEC, UNITS OF CM/S2\n" + lines_of(GAL, "%10.3f", 8), keys)


def of_knet(direction: str, over: int, extra: str = "") -> str:
    """Counts with an offset, eight a line, below 17 lines."""
    counts = np.rint(GAL * over / 2000.0).astype(int) + 4321
    heads = {
        **{"Origin Time": "2026/01/01 00:00:00", "Lat.": "35.0", "Long.": "135.0", "Depth. (km)": "10", "Mag.": "6.0"},
        **{"Station Code": "XXX001", "Station Lat.": "35.1", "Station Long.": "135.1", "Station Height(m)": "10"},
        **{"Record Time": "2026/01/01 00:00:10", "Sampling Freq(Hz)": "200Hz", "Duration Time(s)": "1.985"},
        **{"Dir.": direction, "Scale Factor": f"2000(gal)/{over}", "Max. Acc. (gal)": "250.0"},
        **{"Last Correction": "2026/01/01 00:00:00", "Memo.": extra},
    }
    return "".join(f"{key:18}{value}\n" for key, value in heads.items()) + lines_of(counts, "%8d ", 8)


def of_dyna(kind: str, unit: str, more: str = "") -> str:
    """One number a line below KEY: VALUE."""
    return (
        "EVENT_NAME: OWN\nEVENT_DATE_YYYYMMDD: 20260101\nEVENT_TIME_HHMMSS: 010203\nMAGNITUDE_W: 6.0\n"
        "STATION_CODE: XX01\nVS30_M/S: 600\nSITE_CLASSIFICATION_EC8: B*\nSAMPLING_INTERVAL_S: 0.005000\nNDATA: 397\n"
        f"DURATION_S: 1.985\nSTREAM: HNE\nUNITS: {unit}\nPGA_CM/S^2: -250.1\nDATA_TYPE: {kind}\n{more}USER5: \n"
    ) + lines_of(GAL, "%.6f", 1)


def of_networks() -> Iterator[Written]:
    """K-NET, KiK-net, ESM, ITACA, AFAD."""
    keys, offset = {"x": "1"}, SHOCK.mean()
    yield Written("own.NS", of_knet("N-S", 8388608), keys, SHOCK - offset)
    yield Written("own.EW2", of_knet("5", 6170270, "borehole"), keys | {"unit": "gal"}, SHOCK - offset)
    yield Written("esm.ASC", of_dyna("ACCELERATION", "cm/s^2"), keys)
    yield Written("itaca.ASC", of_dyna("ACCELERATION", "gal", "BASELINE_CORRECTION: BASELINE REMOVED\n"), keys)
    yield Written("speed.ASC", of_dyna("VELOCITY", "cm/s"), keys | {"quantity": "velocity"})
    afad = "PLACE: A TOWN\nNUMBER OF DATA: 397\nSAMPLING INTERVAL(sec): 0.005\n    N-S         E-W         U-D\n"
    three = np.column_stack([0.4 * np.roll(GAL, 90), GAL, 0.2 * np.roll(GAL, 31)]).ravel()
    yield Written("afad.txt", afad + lines_of(three, "%12.4f", 3), {"x": "E-W", "unit": "gal"})


def readable() -> list[Written]:
    """All that are read."""
    return [*tables(), *numbers_alone(), *of_peer(), *of_networks()]


def sac(order: str) -> bytes:
    """A file of SAC: 70 floats, 40 whole numbers, 192 letters, samples."""
    head = struct.pack(f"{order}70f", STEP, *[-12345.0] * 69)
    whole = struct.pack(f"{order}40i", *[-12345] * 6, 6, *[-12345] * 2, COUNT, *[-12345] * 30)
    return head + whole + b"-12345  " * 24 + struct.pack(f"{order}{COUNT}f", *SHOCK)


def foreign() -> dict[str, tuple[str, str | bytes]]:
    """What is not read, by file: the name of the format, and its text."""
    eights = lines_of(GAL, "%10.4f", 8)
    letters = lines_of(np.full(70, -12345.0), "%15.2f", 5) + lines_of(np.full(40, -12345), "%10d", 5)
    return {
        "own.V2c": (
            "COSMOS",
            "Corrected acceleration      (Format v01.20 with 13 text lines) Src: own.V2\nA town\n"
            f" 397   acceleration pts, approx   2 secs, units=cm/sec2 (04),Format=(8F10.4)\n{eights}End-of-data for\n",
        ),
        "own.V1c": ("COSMOS", f"Raw acceleration counts   (Format v01.20 with 13 text lines) Src\n{eights}"),
        "own.V2": (
            "CSMIP",
            "CORRECTED ACCELEROGRAM  Chan  1: 90 Deg\nA town\n"
            f"  397 points of accel data equally spaced at  .005 sec\n{eights}",
        ),
        "own.V2A": (
            "GeoNet",
            "Corrected accelerogram 20160214_001343_NBLC_20 GNS Science\nSite NBLC      43 30 25S  172 43 53E\n"
            f"{lines_of(np.zeros(100), '%8.2f', 10)}{lines_of(10.0 * GAL, '%8.1f', 10)}",
        ),
        "own.V1A": ("GeoNet", f"Uncorrected accelerogram 20160214_001343_NBLC_20 GNS Science\n{eights}"),
        "own.SMC": ("SMC", f"2 CORRECTED ACCELEROGRAM\n*\n*\n{lines_of(np.full(48, -32768), '%10d', 8)}*\n|\n{eights}"),
        "own.sac": ("SAC", sac("<")),
        "big.sac": ("SAC", sac(">")),
        "letters.sac": ("SAC", letters + lines_of(SHOCK, "%15.7f", 5)),
        "own.mseed": ("miniSEED", b"000001D XX01  00HNEXX" + bytes(range(256)) * 4),
        "own.gz": ("packed", b"\x1f\x8b\x08\x00" + bytes(range(128, 256))),
        "own.xlsx": ("packed, or a spreadsheet", b"PK\x03\x04" + bytes(range(128, 256))),
    }
