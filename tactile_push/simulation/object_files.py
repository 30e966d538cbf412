# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Objects and supports as JSON files, lengths in metres.

An object: {"outline": OUTLINE, "centre_of_mass": [x, y], "support": SUPPORT, "mu_c": F}, of which
only the outline must be known. It is one of {"kind": "polygon", "vertices": [[x, y], ...]},
{"kind": "circle", "radius": R}, {"kind": "ellipse", "semi_axes": [a, b]}, {"kind": "smooth",
"points": [[x, y], ...]}. A support: {"points": [[x, y], ...], "loads": [w, ...]}. If the loads are
left out, they are those under the centre of mass; if that is not known, all alike or, of an
object's support, those under the centroid. That may also be {"spread": S}, see `Support.spread`.
"""

import json
import reprlib
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tactile_push.mechanics import Outline, Support
from tactile_push.mechanics.size import check_metres
from tactile_push.small_files import read_small_file

Form = tuple[Callable[[Any], bool], str]


@dataclass(frozen=True, eq=False)
class ObjectFile:
    """What a file says of an object."""

    outline: Outline  #: in the file's frame
    #: centre of mass (x, y) [m]; None if it is not known
    centre_of_mass: tuple[float, float] | None = None
    support: Support | None = None  #: what it rests on; None if that is not known
    mu_c: float | None = None  #: friction between finger and object; None if it is not known


def read_object(file: Path) -> ObjectFile:
    """Read an object.

    Parameters
    ----------
    file : Path
        A JSON file.

    Returns
    -------
    ObjectFile
        What it says.

    Raises
    ------
    OSError
        If the file cannot be read.
    ValueError
        If the file has another form, the outline is not convex or far too large, or the support
        cannot carry the weight.
    """
    return object_of(read_json(file), file)


def object_of(content: dict[str, Any], file: Path) -> ObjectFile:
    """Read an object from the content of a file.

    Parameters
    ----------
    content : dict
        The content.
    file : Path
        The file, for what is said of it.

    Returns
    -------
    ObjectFile
        What it says.

    Raises
    ------
    ValueError
        As `read_object` does.
    """
    outline = content.get('outline')
    outline = outline if isinstance(outline, dict) else {}
    kind, centre, mu_c = outline.get('kind'), content.get('centre_of_mass'), content.get('mu_c')
    try:
        if not (isinstance(kind, str) and kind in OUTLINES):
            raise ValueError(
                f'outline: expected a kind of {", ".join(OUTLINES)}, got {reprlib.repr(kind)}'
            )
        make, key, form = OUTLINES[kind]
        if key not in outline:
            raise ValueError(f'outline: expected {key} of a {kind}, got none')
        made = make(_checked(key, outline[key], form))
        check_metres(key, made)
        if centre is not None:
            x, y = _checked('centre_of_mass', centre, PAIR)
            centre = float(x), float(y)
        if mu_c is not None:
            mu_c = float(_checked('mu_c', mu_c, FRICTION))
        support = content.get('support')
        if support is not None:
            support = _support_of_object(support, made, centre)
    except ValueError as error:
        raise ValueError(f'{file}: {error}') from None
    return ObjectFile(made, centre, support, mu_c)


def read_support(file: Path, centre_of_mass: tuple[float, float] | None = None) -> Support:
    """Read support points.

    Parameters
    ----------
    file : Path
        A JSON file.
    centre_of_mass : tuple of float, optional
        Centre of mass (x, y) [m], if it is known, which decides on loads that the file leaves out.

    Returns
    -------
    Support
        The support.

    Raises
    ------
    OSError
        If the file cannot be read.
    ValueError
        If the file has another form, or the object would tip over.
    """
    content = read_json(file)
    if 'points' not in content:
        raise ValueError(f'{file}: expected "points", got {reprlib.repr(list(content))}')
    try:
        return _points(content, centre_of_mass)
    except ValueError as error:
        raise ValueError(f'{file}: {error}') from None


def _points(content: dict[str, Any], centre_of_mass: tuple[float, float] | None) -> Support:
    points, loads = _checked('points', content['points'], PAIRS), content.get('loads')
    if loads is not None:
        loads = _checked('loads', loads, NUMBERS)
    support = Support.at_points(points, loads)
    if loads is None and centre_of_mass is not None:
        support = support.carrying(centre_of_mass)
    return support


def _support_of_object(
    content: Any, outline: Outline, centre_of_mass: tuple[float, float] | None
) -> Support:
    if not (isinstance(content, dict) and not {'points', 'spread'}.isdisjoint(content)):
        raise ValueError(f'support: expected points or a spread, got {reprlib.repr(content)}')
    try:
        if 'points' in content:
            return _points(content, centre_of_mass or Support.uniform(outline, 1).centre)
        support = Support.spread(outline, _checked('spread', content['spread'], SHARE))
        return support if centre_of_mass is None else support.carrying(centre_of_mass)
    except ValueError as error:
        raise ValueError(f'support: {error}') from None


def read_json(file: Path) -> dict[str, Any]:
    """Read a JSON object.

    Parameters
    ----------
    file : Path
        The file.

    Returns
    -------
    dict
        Its content.

    Raises
    ------
    OSError
        If the file cannot be read.
    ValueError
        If it holds anything else.
    """
    try:
        content = json.loads(read_small_file(file).decode())
    except RecursionError:
        raise ValueError(f'{file}: expected JSON, got one nested too deeply') from None
    except ValueError as error:  # neither JSON nor text
        raise ValueError(f'{file}: expected JSON: {error}') from None
    if not isinstance(content, dict):
        raise ValueError(f'{file}: expected a JSON object, got {type(content).__name__}')
    return content


def _is_number(value: Any) -> bool:
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    return -sys.float_info.max <= value <= sys.float_info.max  # integers may be beyond floats


def _is_pair(value: Any) -> bool:
    return isinstance(value, list) and len(value) == 2 and all(map(_is_number, value))


def are_numbers(value: Any) -> bool:
    """Return whether a value of a file is a list of finite numbers."""
    return isinstance(value, list) and all(map(_is_number, value))


def _are_pairs(value: Any) -> bool:
    return isinstance(value, list) and all(map(_is_pair, value))


def _checked(name: str, value: Any, form: Form) -> Any:
    """Return a value that has the form; refuse any other."""
    fits, what = form
    if not fits(value):
        raise ValueError(f'{name}: expected {what}, got {reprlib.repr(value)}')
    return value


def _ellipse(semi_axes: list[float]) -> Outline:
    if not min(semi_axes) > 0.0:
        raise ValueError(f'semi_axes: expected two positive lengths [m], got {semi_axes}')
    return Outline.ellipse(*semi_axes)


FRICTION: Form = (lambda value: _is_number(value) and value >= 0.0, 'a number of 0 or more')
SHARE: Form = (_is_number, 'a finite number')
NUMBER: Form = (_is_number, 'a finite number [m]')
PAIR: Form = (_is_pair, 'two finite numbers [m]')
PAIRS: Form = (_are_pairs, 'a list of points [x, y], finite numbers [m]')
NUMBERS: Form = (are_numbers, 'a list of finite numbers of 0 or more')
OUTLINES: dict[str, tuple[Callable[[Any], Outline], str, Form]] = {
    'polygon': (Outline.polygon, 'vertices', PAIRS),
    'circle': (Outline.circle, 'radius', NUMBER),
    'ellipse': (_ellipse, 'semi_axes', PAIR),
    'smooth': (Outline.smooth, 'points', PAIRS),
}
