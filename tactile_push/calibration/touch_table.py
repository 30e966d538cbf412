# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The table that says where the tip was touched: a CSV file with one line for each touch."""

import csv
import io
import math
from pathlib import Path
from textwrap import shorten
from typing import NamedTuple

from tactile_push.small_files import read_small_file

TABLE = 'touches.csv'  # its name beside images or a bag
AZIMUTH, ELEVATION = 'azimuth_deg', 'elevation_deg'
FORCE, FILE = 'normal_force', 'file'
MOST_LETTERS = 80  # of a table's first line in a message


class KnownTouch(NamedTuple):
    """Where the tip was touched."""

    azimuth: float  #: [rad]; NaN if nothing touched it
    elevation: float  #: [rad]; NaN as well
    normal_force: float  #: [N]; NaN if it is not known
    file: str  #: the image, relative to the table; '' if the table has no such column

    @property
    def touched(self) -> bool:
        """Whether anything touched the tip."""
        return not math.isnan(self.azimuth)


def read_table(file: Path) -> list[KnownTouch]:
    """Read a table of touches.

    Parameters
    ----------
    file : Path
        A CSV file whose first line names its columns: azimuth_deg and elevation_deg, empty both
        if nothing touched the tip, perhaps normal_force [N], and file for images in a folder.

    Returns
    -------
    list of KnownTouch
        The lines in their order.

    Raises
    ------
    ValueError
        If it is no such table; the message has the file and the line.
    OSError
        If it cannot be read.
    """
    try:
        text = read_small_file(file).decode('utf-8-sig')
        rows = csv.DictReader(io.StringIO(text, newline=''), skipinitialspace=True, strict=True)
        names = rows.fieldnames or []
        for name in (AZIMUTH, ELEVATION):
            if name not in names:
                got = shorten(', '.join(names), MOST_LETTERS) or 'none'
                raise ValueError(f'{file}: expected a column {name}, got {got}')
        return [_touch(row, f'{file}: line {rows.line_num}') for row in rows]
    except (csv.Error, UnicodeDecodeError) as error:
        raise ValueError(f'{file}: no CSV: {error}') from None


def _touch(row: dict[str, str | None], place: str) -> KnownTouch:
    azimuth = _number(row, AZIMUTH, -180.0, 180.0, place)
    elevation = _number(row, ELEVATION, 0.0, 90.0, place)
    if math.isnan(azimuth) != math.isnan(elevation):
        raise ValueError(f'{place}: expected both {AZIMUTH} and {ELEVATION}, or none')
    force = _number(row, FORCE, 0.0, 1e6, place)
    file = (row.get(FILE) or '').strip()
    return KnownTouch(math.radians(azimuth), math.radians(elevation), force, file)


def _number(row: dict[str, str | None], name: str, lower: float, upper: float, place: str) -> float:
    """Return the number in a column, NaN if it is empty or not there."""
    text = (row.get(name) or '').strip()
    try:
        value = float(text) if text else math.nan
        fits = not text or lower <= value <= upper
    except ValueError:
        fits = False
    if not fits:
        raise ValueError(f'{place}: {name}: expected {lower:g} to {upper:g}, got {text!r}')
    return value
