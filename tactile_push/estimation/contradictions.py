# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""When readings contradict the model, and why.

Three explanations that need no object compete with the model: the edge stands still, it turns
arbitrarily, or each reading is anywhere. A cumulative sum per explanation (Page's test) adds up by
how much the logarithm of its probability density is above the model's, and starts again whenever
it falls below 0, so it is about the last readings however long the push has been. As long as the
model is right, a sum rises above h less than once in exp(h) readings. Sums leak, so that a tiny
advantage over very long times says nothing.

An edge also stands still, or turns otherwise than expected, if the contact is not where the model
has it. Belt and outline are blamed only if an object of this outline on a moving belt, pushed
anywhere on the edge, does not explain the readings before and during the contradiction as well.

The test is that of E. S. Page, "Continuous inspection schemes", Biometrika 41, 100-115, 1954.
"""

import math
from collections import deque
from itertools import pairwise

CERTAIN = 12.0  # an explanation that is exp(CERTAIN) times likelier contradicts the model
JUMPY = 15.0  # the same of readings that are anywhere: three outliers in a row
LEAK = 0.01  # what a sum loses per reading, as a share: it forgets within 100 readings
MEMORY = 20  # readings over which surprise is averaged
SURPRISE = 4.0  # mean of squared normalised errors, 1 on average, that contradicts the model
MOST_SURPRISE = 25.0  # what one reading can add to the surprise
OFF = 0.95  # share of the hypotheses off the edge that contradicts the model
NEAR = 6.0  # standard deviations within which readings are the same
CHANGE = 1.0  # way over which the rate of an arbitrarily turning edge changes, in l
BEFORE = 40  # readings before a contradiction begins that tell where the contact was
# The logarithm of how much less likely an explanation may be that does as well. To know the contact
# anywhere on the edge, and not to a fiftieth of it, costs as much.
AS_WELL = math.log(50.0)
AGAIN = 2  # readings outside `NEAR` in a row that show that an edge turns again
FEWEST, MOST = 40, 200  # readings that have to agree after a contradiction

ANYWHERE = 'the readings jump about: is the sensor disturbed?'
JUMPED = 'the edge jumped and stayed there: another object, or another edge?'
STILL = 'the edge does not turn although the object would if it were pushed: does the belt run?'
LEFT = 'the contact has run off the end of the edge'
OTHERWISE = 'the edge turns otherwise than that of any object of this outline: is it another one?'
NOISY = 'the readings scatter far more than the stated noise'
IMPOSSIBLE = 'no object within the bounds on l, r, c, mu_c and noise turns like this'
MOVED = 'the contact is not where it has rolled to along the edge: does the finger tip turn?'
BLIND = 'the direction of the finger tip is unknown: are there joint states of all its joints?'
DISOBEYED = (
    'the joints tell of another motion than was commanded: are names, lengths and signs right?'
)
CONTRADICTIONS = (
    *('', ANYWHERE, JUMPED, STILL, LEFT, OTHERWISE, NOISY, IMPOSSIBLE, MOVED, BLIND, DISOBEYED),
)


class _Line:
    """An edge that turns at a rate which wanders: Kalman filter of theta and the rate."""

    def __init__(self, noise: float, outlier: float, rate: float, change: float) -> None:
        self._noise = noise**2
        self._outlier = outlier
        self._rate = rate**2  # variance of the rate at first [rad^2/m^2]
        self._change = change**2  # growth of it with the way [rad^2/m^3]
        self.sum = 0.0

    def start(self, theta: float) -> None:
        self.sum = 0.0
        self.readings = 0  # since then
        self._theta, self._slope = theta, 0.0
        self._tt, self._ts, self._ss = self._noise, 0.0, self._rate

    def read(self, theta: float, way: float, log_density: float) -> None:
        """Move on by a way, take the reading and compare with the model."""
        self.readings += 1
        self._theta += way * self._slope
        grown = self._change * way
        self._tt += way * (2.0 * self._ts + way * (self._ss + grown / 3.0))
        self._ts += way * (self._ss + grown / 2.0)
        self._ss += grown
        spread, error = self._tt + self._noise, theta - self._theta
        likely = (1.0 - self._outlier) * math.exp(-error * error / (2.0 * spread))
        likely /= math.sqrt(2.0 * math.pi * spread)
        anywhere = self._outlier / math.pi
        self.sum += math.log(likely + anywhere) - log_density - LEAK * self.sum
        if self.sum <= 0.0:
            self.start(theta)
        elif likely > anywhere:
            self._theta += self._tt / spread * error
            self._slope += self._ts / spread * error
            self._ss -= self._ts * self._ts / spread
            self._ts *= self._noise / spread
            self._tt *= self._noise / spread


class Watch:
    """Finds out why the readings of one push contradict the model.

    A reading whose log density is no greater than `outlier` is rather an outlier than not.
    `surprise` is the mean square of the last readings' normalised errors, 1 on average. `reason`
    says why no number is to be believed, '' if model and readings agree; it stays.
    """

    def __init__(self, noise: float, outlier: float, l: float, theta: float) -> None:
        self._noise = noise  # standard deviation of the readings [rad]
        # No object turns by more than 1/(2 l) a metre, eq. (11).
        self._fastest = 0.5 / l
        change = self._fastest / math.sqrt(CHANGE * l)
        self._still = _Line(noise, outlier, 0.0, 0.0)
        self._turning = _Line(noise, outlier, self._fastest, change)
        self._anywhere = 0.0
        self.outlier = math.log(2.0 * outlier / math.pi)
        self._since = deque([theta], MEMORY)  # readings from the last one that was believed
        self._gone = 0.0  # how far the finger has pushed since [m]
        self._still.start(theta)
        self._turning.start(theta)
        self.surprise = 1.0
        self.reason = ''

    def read(self, theta: float, way: float, error: float, log_density: float, off: float) -> None:
        """Compare a reading with what the model says.

        `way` is how far the finger has pushed since the last reading [m], `error` the reading's
        error in standard deviations, `log_density` the logarithm of its probability density under
        the model [1/rad], and `off` the share of the hypotheses that have run off the edge.
        """
        self._since.append(theta)
        self._gone += way
        if log_density > self.outlier:
            self._since = deque([theta], MEMORY)
            self._gone = 0.0
            self.surprise += (min(error**2, MOST_SURPRISE) - self.surprise) / MEMORY
        self._still.read(theta, way, log_density)
        self._turning.read(theta, way, log_density)
        self._anywhere -= math.log(math.pi) + log_density + LEAK * self._anywhere
        self._anywhere = max(0.0, self._anywhere)
        if not self.reason:
            self.reason = self._why(off)

    @property
    def doubtful(self) -> int:
        """Number of the last readings that led to a contradiction which may be the contact's alone.

        They are those that the edge has stood still or turned otherwise, and some before; 0 if
        there is no such contradiction.
        """
        return self._blamed().readings + BEFORE if self.reason in (STILL, OTHERWISE) else 0

    def compare(self, gain: float) -> None:
        """Blame neither belt nor outline if another contact on the edge does as well.

        `gain` is by how much the logarithm of the probability density of the doubtful readings is
        above the model's if the contact may have been anywhere on the edge before them.
        """
        if gain > self._blamed().sum - AS_WELL:
            self.reason = MOVED

    def _blamed(self) -> _Line:
        """Return the edge that explains the doubtful readings best."""
        return self._still if self.reason == STILL else self._turning

    def _why(self, off: float) -> str:
        """Return what contradicts the model now."""
        still, turning, anywhere = self._still.sum, self._turning.sum, self._anywhere
        most = max(still, turning, anywhere)
        certain = max(still, turning) > CERTAIN or anywhere > JUMPY
        if off > OFF or (certain and off > 0.5):
            return LEFT
        if certain:
            jumps = self._jumps()
            if jumps > 1 or anywhere == most:
                return ANYWHERE
            if jumps == 1:
                return JUMPED
            # An arbitrarily turning edge may also stand still.
            return STILL if still > turning - 1.0 else OTHERWISE
        return NOISY if self.surprise > SURPRISE else ''

    def _jumps(self) -> int:
        """Count the jumps since a reading was believed."""
        readings = list(self._since)
        way = self._gone / max(len(readings) - 1, 1)
        # Another object may turn faster, if it is smaller.
        farthest = NEAR * self._noise + 2.0 * self._fastest * way
        return sum(abs(after - before) > farthest for before, after in pairwise(readings))


class Probation:
    """Decides when to believe an estimator again that began anew after a contradiction.

    As many readings in a row must agree as there were before the contradiction, between 40 and 200:
    a model that is always wrong would be contradicted again within so many. If the contradiction
    was an edge that did not turn, the edge must turn again first, because a stopped belt looks like
    an object that translates.
    """

    def __init__(self, noise: float) -> None:
        self._noise = noise
        self.reset()

    def reset(self) -> None:
        """Forget everything."""
        self.reason = ''
        self._readings = 0
        self._needed = 0
        self._stood: float | None = None
        self._outside = 0

    def contradicted(self, reason: str, theta: float) -> None:
        """Take a contradiction at the reading theta [rad]."""
        self._needed = min(max(self._readings, FEWEST), MOST)
        self._readings = self._outside = 0
        self._stood = theta if reason == STILL else None
        self.reason = reason

    def agreed(self, theta: float) -> bool:
        """Take a reading that agrees; return whether to begin anew since the edge still stands."""
        if self._stood is not None:
            near = abs(theta - self._stood) < NEAR * self._noise
            self._outside = 0 if near else self._outside + 1
            if self._outside < AGAIN:
                return True
            self._stood = None
        self._readings += 1
        if self._readings >= self._needed:
            self.reason = ''
        return False
