# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a report shows of one run, in SI units; time counts from the start of the bag."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

NOTE, WARNING, ERROR = LEVELS = 'note', 'warning', 'error'


@dataclass(frozen=True)
class Series:
    """A quantity as it was recorded.

    Parameters
    ----------
    time : ndarray, shape (N,)
        When [s], not decreasing.
    values : ndarray, shape (N,)
        What; NaN where there was no value.
    """

    time: npt.NDArray[np.float64]
    values: npt.NDArray[np.float64]


@dataclass(frozen=True)
class Episode:
    """Something out of the ordinary, for as long as it lasted.

    Parameters
    ----------
    lane : str
        Whose matter it is: episodes of one lane are shown in one row.
    start, end : float
        When [s].
    text : str
        What.
    level : str
        One of `LEVELS`.
    """

    lane: str
    start: float
    end: float
    text: str
    level: str


@dataclass(frozen=True)
class Scene:
    """What the view from above needs to know beside the run.

    Parameters
    ----------
    radius : float
        Effective radius of the finger's disk [m].
    outline : sequence of tuple of float, optional
        Points of the object's outline relative to its centre of mass [m]; none if not known.
    mu_c : float, optional
        Friction between finger and object, 0 to infinity.
    """

    radius: float
    outline: Sequence[tuple[float, float]] = ()
    mu_c: float | None = None


@dataclass(frozen=True)
class Run:
    """A run.

    Parameters
    ----------
    name : str
        Of the bag.
    duration : float
        From the first message to the last [s].
    series : mapping of str to Series
        Those that the bag has of `SERIES`.
    states : sequence of str
        What the controller can be doing: the values of the series 'state' are indices.
    episodes : sequence of Episode
        In the order of their start.
    scene : Scene
        For the view from above.
    facts : sequence of str, optional
        Of the bag as a whole.
    outcome : sequence of tuple of str, optional
        Figures of merit: what, its value, the paper's.
    tables : mapping of str to sequence of tuple of str, optional
        What else there is to know: topics, parameters; by title.
    warnings : sequence of str, optional
        What is amiss with the bag.
    """

    name: str
    duration: float
    series: Mapping[str, Series]
    states: Sequence[str]
    episodes: Sequence[Episode]
    scene: Scene
    facts: Sequence[str] = ()
    outcome: Sequence[tuple[str, str, str]] = ()
    tables: Mapping[str, Sequence[tuple[str, ...]]] = field(default_factory=dict)
    warnings: Sequence[str] = ()
