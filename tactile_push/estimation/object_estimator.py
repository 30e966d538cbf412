# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Where an object is whose outline is known, but not the edge that the finger pushes."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import compress

import numpy as np

from tactile_push.estimation.contact_estimator import ContactEstimator, Estimate, Quantity
from tactile_push.estimation.contenders import Contenders
from tactile_push.estimation.edges import Edge
from tactile_push.estimation.pose import object_pose
from tactile_push.estimation.prior import Prior
from tactile_push.mechanics.compiled import Array
from tactile_push.paper import FINGER_RADIUS

ALIKE = 1e-6  # of lengths and weights, in units of themselves
EDGE_EXCLUDED = 0.01  # weight of an edge, of the best one's, that the 95 % intervals leave out


@dataclass(frozen=True, eq=False)
class ObjectEstimate:
    """What is known of the object at the last reading.

    Of `d`, `c` and `mu_c` it is the mean under the most likely edge, the hull of the 95 % intervals
    of all edges that are not unlikely, and the hull of the guaranteed bounds of all edges that are
    not excluded. The pose is that under the most likely edge, with a covariance that covers the
    other edges that may be pushed; both are NaN before the first reading. With a contradiction, all
    else is what was known before any data.
    """

    edges: tuple[Edge, ...]  #: the edges that may be pushed; none of a disk
    weights: Array  #: probability of each one, shape (N,)
    estimates: tuple[Estimate, ...]  #: what is known if it is this one
    edge: int  #: index of the most likely one; -1 of a disk
    d: Quantity  #: contact along the edge [m]
    c: Quantity  #: m_max / f_max [m]
    mu_c: Quantity  #: friction between finger and object
    theta: float  #: angle of the pushed edge [rad]; NaN before the first reading
    surprise: float  #: mean square of the last readings' normalised errors, 1 on average
    contradiction: str  #: why to believe no number, one of `CONTRADICTIONS`; empty otherwise
    pose: Array  #: centre of mass x, y [m] and angle [rad] in the frame of the disk, shape (3,)
    covariance: Array  #: mean products of deviations from `pose`, shape (3, 3)


class Estimator:
    """What the estimators of an edge and of a disk have in common."""

    def __init__(self, contenders: Contenders, noise: float) -> None:
        self._contenders = contenders
        self.noise = noise  # standard deviation of the readings of theta [rad]

    def reset(self) -> None:
        """Forget everything, as when the finger has lost the object."""
        self._contenders.reset()

    def push(
        self, theta: float, v_x: float, v_y: float, duration: float, spin: float = 0.0
    ) -> ObjectEstimate:
        """Take a push and the reading at its end.

        Parameters
        ----------
        theta : float
            Reading of the pushed edge's or tangent's angle [rad]; NaN without one.
        v_x, v_y : float
            Mean velocity of the disk's centre relative to the support since the last call [m/s].
        duration : float
            Time since the last call [s]; 0 for a reading without a push, as the first one is.
        spin : float, optional
            Mean angular velocity of the finger's disk since the last call [rad/s].

        Returns
        -------
        ObjectEstimate
            What is known now.

        Raises
        ------
        ValueError
            If a velocity is not finite, or the duration negative or not finite.
        """
        self._contenders.push(theta, v_x, v_y, duration, spin)
        return self.estimate()

    def touch_again(self, theta: float, way: float, unfelt: float) -> ObjectEstimate:
        """Take the first reading after the finger has left the object and touched it elsewhere.

        What is known of the object stays, and so does the edge that is pushed. Of a disk everything
        is forgotten.

        Parameters
        ----------
        theta : float
            Reading of the pushed edge's angle [rad].
        way : float
            How far the finger has gone across since the last reading [m].
        unfelt : float
            How far it may have pushed meanwhile without a reading [m].

        Returns
        -------
        ObjectEstimate
            What is known now.
        """
        self.reset()
        return self.push(theta, 0.0, 0.0, 0.0)

    def estimate(self) -> ObjectEstimate:
        """Return what is known; before any data and after a contradiction, what was known before.

        Returns
        -------
        ObjectEstimate
            The estimate; a disk has no edges.
        """
        raise NotImplementedError


class ObjectEstimator(Estimator):
    """Follows the contact under every edge that may be pushed, and weighs the edges.

    Before any data the finger is equally likely anywhere on the outline. Edges that lie alike to
    the centre of mass, such as opposite edges of a rectangle, share one estimate, because no
    reading of theta tells them apart.

    Parameters
    ----------
    edges : sequence of Edge
        The edges that may be pushed, one if it is known.
    noise : float
        Standard deviation of the readings of theta [rad], positive.
    c : tuple of float, optional
        Least and most c [m].
    mu_c : tuple of float, optional
        Least and most friction between finger and object, 0 to infinity.
    l_share : float, optional
        Standard deviation of each edge's l, as a share of it: 0.085 covers errors of a tenth of l
        and r.
    radius : float, optional
        Effective radius of the finger's disk [m].
    radius_share : float, optional
        Its standard deviation, as a share of it.
    outlier : float, optional
        Probability that a reading is wrong altogether.
    tilt : float, optional
        Greatest mu_s times height of the push above the support [m]; see `ExactLimitSurface`.

    Raises
    ------
    ValueError
        If there is no edge, or a number is out of its range.
    """

    def __init__(
        self,
        edges: Sequence[Edge],
        noise: float,
        *,
        c: tuple[float, float] = (0.005, 0.036),
        mu_c: tuple[float, float] = (0.0, math.inf),
        l_share: float = 0.085,
        radius: float = FINGER_RADIUS,
        radius_share: float = 0.085,
        outlier: float = 0.001,
        tilt: float = 0.0,
    ) -> None:
        if not edges:
            raise ValueError('edges: expected one or more')
        self.edges = tuple(edges)
        places: list[Edge] = []
        place_of: list[int] = []
        for edge in self.edges:
            slack = ALIKE * edge.length
            alike = [i for i, place in enumerate(places) if edge.same_place(place, slack)]
            place_of.append(alike[0] if alike else len(places))
            if not alike:
                places.append(edge)
        lengths = np.array([edge.length for edge in self.edges])
        together = np.bincount(place_of, lengths)
        self._place_of = place_of
        self._shares = lengths / together[place_of]
        estimators = [
            ContactEstimator(
                Prior(place.d, place.l, l_share * place.l, c, mu_c, place.moments, tilt),
                noise,
                radius=radius,
                radius_sigma=radius_share * radius,
                outlier=outlier,
            )
            for place in places
        ]
        super().__init__(Contenders(estimators, together / together.sum(), noise), noise)

    def touch_again(self, theta: float, way: float, unfelt: float) -> ObjectEstimate:
        """Take the first reading of another contact, as in `Estimator`.

        Parameters
        ----------
        theta, way, unfelt : float
            As in `Estimator`.

        Returns
        -------
        ObjectEstimate
            What is known now.
        """
        self._contenders.touch_again(theta, way, unfelt)
        return self.estimate()

    def estimate(self) -> ObjectEstimate:
        """Return what is known, as in `Estimator`.

        Returns
        -------
        ObjectEstimate
            The estimate.
        """
        found, possible = self._contenders.estimates, self._contenders.possible
        estimates = tuple(found[i] for i in self._place_of)
        weights = self._contenders.weights[self._place_of] * self._shares
        # The first of equally likely edges, so that rounding does not choose.
        best = int(np.argmax(weights > (1.0 - ALIKE) * weights.max()))
        likely = weights > EDGE_EXCLUDED * weights.max()
        bounded = [possible[i] for i in self._place_of]
        d, c, mu_c = (
            Quantity(
                getattr(estimates[best], name).mean,
                min(getattr(one, name).lower for one in compress(estimates, likely)),
                max(getattr(one, name).upper for one in compress(estimates, likely)),
                min(getattr(one, name).least for one in compress(estimates, bounded)),
                max(getattr(one, name).most for one in compress(estimates, bounded)),
            )
            for name in ('d', 'c', 'mu_c')
        )
        pose, covariance = self._pose(estimates, weights, best)
        theta, surprise = estimates[best].theta, estimates[best].surprise
        known = d, c, mu_c, theta, surprise, self._contenders.contradiction
        return ObjectEstimate(self.edges, weights, estimates, best, *known, pose, covariance)

    def _pose(
        self, estimates: tuple[Estimate, ...], weights: Array, best: int
    ) -> tuple[Array, Array]:
        """Return the pose under the best edge and all edges' deviations from it."""
        poses, covariance = [], np.zeros((3, 3))
        for edge, weight, estimate in zip(self.edges, weights, estimates, strict=True):
            pose, own = object_pose(estimate)
            pose[2] = math.remainder(pose[2] - edge.angle, math.tau)
            poses.append(pose)
            covariance += weight * own
        for weight, pose in zip(weights, poses, strict=True):
            offset = pose - poses[best]
            offset[2] = math.remainder(offset[2], math.tau)
            covariance += weight * np.outer(offset, offset)
        return poses[best], covariance
