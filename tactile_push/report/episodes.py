# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From what was said again and again to what lasted from when to when."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from tactile_push.report.data import Episode

Label = tuple[str, str]
"""Level and text."""


def episodes(
    lane: str, time: npt.ArrayLike, labels: Sequence[Label | None], longest: float
) -> list[Episode]:
    """Return how long each label lasted, in the order of time.

    Label k was given at time k [s]; None is nothing out of the ordinary. A label counts for
    `longest` seconds if no other follows.
    """
    times = np.asarray(time, dtype=float).tolist()
    starts = [i for i in range(len(labels)) if i == 0 or labels[i] != labels[i - 1]]
    found = []
    for first, after in pairwise([*starts, len(labels)]):
        label = labels[first]
        if label is None:
            continue
        end = times[after - 1] + longest
        if after < len(labels):
            end = min(end, times[after])
        found.append(Episode(lane, times[first], end, label[1], label[0]))
    return found


def joined(found: Iterable[Episode], gap: float, end: float) -> list[Episode]:
    """Join equal episodes with a gap of no more than `gap` seconds between them.

    No episode outlasts `end`, the end of the run [s]. They come in the order of their start.
    """
    last: dict[tuple[str, str, str], Episode] = {}
    done = []
    for episode in sorted(found, key=lambda episode: episode.start):
        episode = replace(episode, end=min(episode.end, end))
        key = episode.lane, episode.text, episode.level
        before = last.get(key)
        if before is not None and episode.start - before.end <= gap:
            episode = replace(before, end=max(before.end, episode.end))
        elif before is not None:
            done.append(before)
        last[key] = episode
    return sorted([*done, *last.values()], key=lambda episode: (episode.start, episode.lane))
