# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a report shows of one run, as `run` reads it; SI units, time from the start of the bag."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

NOTE, WARNING, ERROR = LEVELS = 'note', 'warning', 'error'


@dataclass(frozen=True)
class Series:
    """A quantity as it was recorded."""

    time: npt.NDArray[np.float64]  # not decreasing [s]
    values: npt.NDArray[np.float64]  # NaN where there was none


@dataclass(frozen=True)
class Episode:
    """Something out of the ordinary, for as long as it lasted."""

    lane: str  # episodes of one lane are shown in one row
    start: float  # [s]
    end: float  # [s]
    text: str
    level: str  # one of `LEVELS`


@dataclass(frozen=True)
class Scene:
    """What the view from above needs beside the run."""

    radius: float  # effective radius of the finger's disk [m]
    # Of the object about its centre of mass [m]; empty if it is not known
    outline: Sequence[tuple[float, float]] = ()
    mu_c: float | None = None  # friction between finger and object


@dataclass(frozen=True)
class Run:
    """A run."""

    name: str  # of the bag
    duration: float  # from the first message to the last [s]
    series: Mapping[str, Series]  # those of the page's `SERIES` and `VIEWED` that the bag has
    states: Sequence[str]  # what the controller can be doing, by the values of the series 'state'
    episodes: Sequence[Episode]  # in the order of their start
    scene: Scene
    facts: Sequence[str] = ()  # about the bag as a whole
    outcome: Sequence[tuple[str, str, str]] = ()  # figures of merit: what, its value, the paper's
    # What became of each goal to place an object at, as cells of a row
    goals: Sequence[tuple[str, ...]] = ()
    drawings: Sequence[tuple[str, str]] = ()  # of the placed objects: title and SVG
    # Topics and parameters by title
    tables: Mapping[str, Sequence[tuple[str, ...]]] = field(default_factory=dict)
    warnings: Sequence[str] = ()  # what is wrong with the bag
