# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""The finger tip's direction at the moment of a reading."""

from collections import deque


class StaleJointsError(ValueError):
    """No joint state near enough in time; the message is the reason in two or three words."""


class PoleHistory:
    """Remembers the pole's angle for a while and gives it at a reading's time.

    Parameters
    ----------
    timeout : float
        How far beyond the remembered times an angle is still used [s].
    length : int, optional
        How many angles are remembered.
    """

    def __init__(self, timeout: float, length: int = 64) -> None:
        self.timeout = timeout
        self._angles: deque[tuple[float, float]] = deque(maxlen=length)

    def record(self, stamp: float, psi: float) -> None:
        """Remember an angle.

        Parameters
        ----------
        stamp : float
            When the joints were read [s]. A step back starts over: the clock was set.
        psi : float
            Angle of the pole [rad].
        """
        if self._angles and stamp < self._angles[-1][0]:
            self._angles.clear()
        self._angles.append((stamp, psi))

    def at(self, stamp: float) -> float:
        """Give the pole's angle at a time.

        Parameters
        ----------
        stamp : float
            When the sensor was read [s].

        Returns
        -------
        float
            psi [rad], interpolated between the neighbours in time; the nearest before the first
            and after the last.

        Raises
        ------
        StaleJointsError
            If the time is further than `timeout` outside what is remembered.
        """
        if not self._angles:
            raise StaleJointsError('no joint state')
        later = None
        for earlier in reversed(self._angles):
            if earlier[0] <= stamp:
                break
            later = earlier
        else:
            return self._nearest(self._angles[0], stamp)
        if later is None:
            return self._nearest(earlier, stamp)
        (t0, psi0), (t1, psi1) = earlier, later
        return psi0 + (psi1 - psi0) * (stamp - t0) / (t1 - t0)

    def _nearest(self, remembered: tuple[float, float], stamp: float) -> float:
        if not abs(stamp - remembered[0]) <= self.timeout:
            raise StaleJointsError('stale joint state')
        return remembered[1]
