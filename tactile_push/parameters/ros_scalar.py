# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Values of a parameter file as `rcl` reads them: by the rules of C, not by those of YAML."""

import math
import re
import sys
from typing import Any

TRUE = ('Y', 'y', 'yes', 'Yes', 'YES', 'true', 'True', 'TRUE', 'on', 'On', 'ON')
FALSE = ('N', 'n', 'no', 'No', 'NO', 'false', 'False', 'FALSE', 'off', 'Off', 'OFF')
# What strtoll takes for a whole number with base 0, and strtod for a number.
_WHOLE = re.compile(r'\s*([+-]?)(?:0x([0-9a-f]+)|(0[0-7]*)|([1-9][0-9]*))', re.ASCII | re.I)
_DECIMAL = re.compile(r'\s*[+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?', re.ASCII | re.I)
_BINARY = re.compile(
    r'\s*[+-]?0x(?:[0-9a-f]+\.?[0-9a-f]*|\.[0-9a-f]+)(?:p[+-]?\d+)?', re.ASCII | re.I
)
_NO_DECIMAL = re.compile(r'\s*([+-]?)(inf(?:inity)?|nan(?:\(\w*\))?)', re.ASCII | re.I)
_YAML_WORD = re.compile(r'\.(?:nan|NaN|NAN)|([+-]?)\.(?:inf|Inf|INF)')
_TEXT_TAG = 'tag:yaml.org,2002:str'


def scalar(event: Any) -> bool | int | float | str:
    """Return the value of a scalar.

    Parameters
    ----------
    event : yaml.ScalarEvent
        The scalar as it stands in the file.

    Raises
    ------
    ValueError
        If there is no value.
    """
    text: str = event.value
    quoted = event.style in ("'", '"')
    if not text and not quoted:
        raise ValueError('expected a value')
    if quoted or event.tag == _TEXT_TAG:
        return text
    if text in TRUE or text in FALSE:
        return text in TRUE
    whole = _whole(text)
    number = _real(text) if whole is None else whole
    return text if number is None else number


def _whole(text: str) -> int | None:
    """Return a whole number of 64 bits; a leading 0 makes it octal, 0x hexadecimal."""
    found = _WHOLE.fullmatch(text)
    if found is None:
        return None
    sign, hexadecimal, octal, decimal = found.groups()
    number = int(hexadecimal or octal or decimal, 16 if hexadecimal else 8 if octal else 10)
    number = -number if sign == '-' else number
    return number if -(2**63) <= number < 2**63 else None


def _real(text: str) -> float | None:
    """Return a real number; None if it is none, or none that a double has room for."""
    if found := _YAML_WORD.fullmatch(text) or _NO_DECIMAL.fullmatch(text):
        sign = -1.0 if found[1] == '-' else 1.0
        return math.copysign(math.inf if 'inf' in text.lower() else math.nan, sign)
    if _DECIMAL.fullmatch(text):
        number, digits = float(text), text.lower().partition('e')[0]
    elif _BINARY.fullmatch(text):
        digits = text.lower().partition('p')[0].partition('x')[2]
        try:
            number = float.fromhex(text)
        except OverflowError:
            return None
    else:
        return None
    too_small = abs(number) < sys.float_info.min and any(d in '123456789abcdef' for d in digits)
    return None if math.isinf(number) or too_small else number
