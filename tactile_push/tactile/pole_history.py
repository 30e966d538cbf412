# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The finger tip's direction at the moment of a reading."""

import math
from bisect import bisect_left, bisect_right

from tactile_push.tactile.hemisphere import ReadingRejectedError, normalized_angle

JOINT_STATE_TIMEOUT = 0.1  # between a reading and its joint state [s]: a control period
BELIEVED = 3  # so many agreeing values in a row are no accident; two may come twice or late


class PoleHistory:
    """Remembers the pole's angle for a while and returns it at a reading's time.

    Angles are interpolated the shorter way around, so that a joint which reports its angle in
    (-pi, pi] may pass the end of that range.

    The stamps of joint states are expected to increase. One that is not newer than the newest is
    ignored: it came late or twice. `BELIEVED` of them in a row, each newer than the one before,
    mean that the clock was set back, or that the newest had been stamped in the future: what is
    remembered then starts over with these.
    """

    def __init__(self, timeout: float, length: int = 256) -> None:
        self.timeout = timeout  # how far in time the nearest angle may be [s]; may be changed
        self.age = math.nan  # how far it was when an angle was last asked for [s]
        self._length = length
        self._stamps: list[float] = []
        self._angles: list[float] = []
        self._late: list[tuple[float, float]] = []

    def record(self, stamp: float, psi: float) -> bool:
        """Remember an angle; return False if it is not finite or not newer than the newest."""
        if not (math.isfinite(stamp) and math.isfinite(psi)):
            return False
        psi = normalized_angle(psi)
        stamps, angles, late = self._stamps, self._angles, self._late
        if not stamps or stamp > stamps[-1]:
            stamps.append(stamp)
            angles.append(psi)
            late.clear()
            if len(stamps) > self._length:
                del stamps[0], angles[0]
            return True
        if late and stamp <= late[-1][0]:
            late.clear()
        late.append((stamp, psi))
        if len(late) < BELIEVED:
            return False
        stamps[:], angles[:] = map(list, zip(*late, strict=True))
        late.clear()
        return True

    def at(self, stamp: float) -> float:
        """Return the pole's angle at a time; refuse the reading if none is known within `timeout`.

        Between two remembered times it is interpolated. After the newest it goes on as it turned
        on average since the oldest one that is at most `timeout` older than the newest: over two
        neighbours alone the noise of the joint angles would be magnified. It goes on for no longer
        than it was watched turning, so the noise is at most doubled. Before the oldest it is the
        oldest.
        """
        stamps, angles = self._stamps, self._angles
        if not stamps:
            raise ReadingRejectedError('no joint state')
        newest = stamps[-1]
        if not stamp < newest:
            ahead = stamp - newest
            self._check_age(ahead)
            oldest = bisect_left(stamps, newest - self.timeout)
            if ahead == 0.0 or oldest == len(stamps) - 1:
                return angles[-1]
            turned = math.remainder(angles[-1] - angles[oldest], 2.0 * math.pi)
            return angles[-1] + turned * min(ahead / (newest - stamps[oldest]), 1.0)
        later = bisect_right(stamps, stamp)
        if later == 0:
            self._check_age(stamps[0] - stamp)
            return angles[0]
        t0, t1 = stamps[later - 1], stamps[later]
        self._check_age(min(stamp - t0, t1 - stamp))
        turned = math.remainder(angles[later] - angles[later - 1], 2.0 * math.pi)
        return angles[later - 1] + turned * (stamp - t0) / (t1 - t0)

    def _check_age(self, age: float) -> None:
        self.age = age
        if not age <= self.timeout:
            raise ReadingRejectedError('stale joint state')
