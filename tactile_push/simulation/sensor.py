# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A sensor that errs (Section V.D): what it reads, what it sends, and when."""

import math
from collections import deque
from dataclasses import dataclass

import numpy as np

from tactile_push.tactile import NO_CONTACT, Reading, reading_of_contact

POLE = math.pi / 2.0  # angle of the pole when angles count from the equator's right end
LIKELY = math.radians(3.0)  # noise beyond it looks like a wrong reading: `JUMP_TOLERANCE` is 4.6°


@dataclass(frozen=True)
class Sensor:
    """How the sensor errs; by default not at all.

    Noise, bias and quantum act on the contact's angle in the plane of motion, from the pole to the
    left.

    Raises
    ------
    ValueError
        If a number is out of its range.
    """

    noise: float = 0.0  #: standard deviation of the Gaussian noise [rad]
    bias: float = 0.0  #: constant error [rad]
    quantum: float = 0.0  #: angles are whole multiples of it [rad]; 0 for all angles
    latency: float = 0.0  #: time from the reading to the sentence [s]
    dropout: float = 0.0  #: probability that a reading is lost on the way
    outlier: float = 0.0  #: probability that a reading is anywhere on the hemisphere, evenly
    stuck: bool = False  #: whether it reads the last value for ever
    detectable_range: float = math.pi / 2.0  #: it feels contacts so far from the pole [rad]

    def __post_init__(self) -> None:
        for name in ('noise', 'quantum', 'latency', 'detectable_range'):
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= 0.0):
                raise ValueError(f'{name}: expected a finite number of 0 or more, got {value}')
        if not math.isfinite(self.bias):
            raise ValueError(f'bias: expected a finite angle [rad], got {self.bias}')
        for name in ('dropout', 'outlier'):
            value = getattr(self, name)
            if not 0.0 <= value <= 1.0:
                raise ValueError(f'{name}: expected a probability from 0 to 1, got {value}')


@dataclass(frozen=True)
class Sample:
    """A reading on its way out."""

    taken: float  # when it was read [s]
    reading: Reading | None  # what is sent; None if it is lost on the way
    likely: bool  # whether it is so near to the truth that nobody should refuse it


class Readout:
    """What comes out of a sensor, and when.

    Each kind of random error has its own random stream, so switching one on does not change the
    others. The same seed makes the same run, to the bit.

    Parameters
    ----------
    sensor : Sensor
        How the sensor errs.
    seed : int
        Seed of the random numbers, 0 or more.
    """

    def __init__(self, sensor: Sensor, seed: int) -> None:
        self.sensor = sensor  #: may be replaced at any time
        streams = np.random.SeedSequence(seed).spawn(4)
        self._noise, self._lost, self._wrong, self._place = map(np.random.default_rng, streams)
        self._last: Reading | None = None
        self._under_way: deque[Sample] = deque()

    def read(self, truth: Reading, now: float) -> list[Sample]:
        """Read the sensor, and take what has come out by now.

        Parameters
        ----------
        truth : Reading
            What a perfect sensor reads.
        now : float
            Time [s].

        Returns
        -------
        list of Sample
            The samples that come out, in the order in which they were taken.
        """
        self._under_way.append(self._sample(truth, now))
        out = []
        while self._under_way:
            due = self._under_way[0].taken + self.sensor.latency
            if due > now and not math.isclose(due, now):
                break
            out.append(self._under_way.popleft())
        return out

    def _sample(self, truth: Reading, now: float) -> Sample:
        sensor = self.sensor
        noise = sensor.noise * self._noise.standard_normal() if sensor.noise > 0.0 else 0.0
        wrong = sensor.outlier > 0.0 and self._wrong.random() < sensor.outlier
        if sensor.stuck and self._last is not None:
            reading, wrong = self._last, False
        elif wrong:
            # Evenly over the sphere's surface: its area goes with the height above the equator.
            azimuth, height = self._place.uniform((-math.pi, 0.0), (math.pi, 1.0))
            reading = Reading(float(azimuth), math.asin(height))
        else:
            reading = self._measured(truth, noise)
        self._last = reading
        likely = reading.in_contact and not wrong and abs(noise) <= LIKELY
        lost = sensor.dropout > 0.0 and self._lost.random() < sensor.dropout
        return Sample(now, None if lost else reading, likely)

    def _measured(self, truth: Reading, noise: float) -> Reading:
        sensor = self.sensor
        if not truth.in_contact or POLE - truth.elevation > sensor.detectable_range:
            return NO_CONTACT
        error = sensor.bias + noise
        if error == sensor.quantum == 0.0:
            return truth
        angle = math.copysign(POLE - truth.elevation, math.cos(truth.azimuth)) + error
        if sensor.quantum > 0.0:
            angle = sensor.quantum * round(angle / sensor.quantum)
        angle = min(max(angle, -POLE), POLE)  # it reads no further than to the equator
        return reading_of_contact(angle, POLE, truth.normal_force) or NO_CONTACT
