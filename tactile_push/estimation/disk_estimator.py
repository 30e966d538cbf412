# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Where a pushed disk is."""

import math

import numpy as np

from tactile_push.estimation.contact_estimator import ContactEstimator
from tactile_push.estimation.contenders import Contenders
from tactile_push.estimation.object_estimator import Estimator, ObjectEstimate
from tactile_push.estimation.pose import object_pose
from tactile_push.estimation.prior import Prior
from tactile_push.paper import FINGER_RADIUS

ANY_ORIENTATION = math.tau**2 / 12.0  # variance of the disk's angle, unknown [rad^2]


class DiskEstimator(Estimator):
    """Follows the contact with a disk about its centre of mass.

    The tangent at the contact is the edge, so d is 0. theta determines where the disk is; how
    theta changes depends on c and mu_c.

    Parameters
    ----------
    disk_radius : float
        Radius of the disk that is pushed [m].
    noise : float
        Standard deviation of the readings of theta [rad], positive.
    c : tuple of float, optional
        Least and most c [m].
    mu_c : tuple of float, optional
        Least and most friction between finger and object, 0 to infinity.
    l_share : float, optional
        Standard deviation of the disk's radius, as a share of it.
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
        If a number is out of its range.
    """

    def __init__(
        self,
        disk_radius: float,
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
        estimator = ContactEstimator(
            Prior((0.0, 0.0), disk_radius, l_share * disk_radius, c, mu_c, tilt=tilt),
            noise,
            radius=radius,
            radius_sigma=radius_share * radius,
            outlier=outlier,
            disk=True,
        )
        super().__init__(Contenders([estimator], np.ones(1), noise), noise)

    def estimate(self) -> ObjectEstimate:
        """Return what is known, as in `Estimator`.

        Returns
        -------
        ObjectEstimate
            The estimate.
        """
        (estimate,) = self._contenders.estimates
        pose, covariance = object_pose(estimate)
        # How the disk has turned since it was put down shows nowhere.
        pose[2] = 0.0
        covariance[2, :] = covariance[:, 2] = 0.0
        covariance[2, 2] = ANY_ORIENTATION
        known = estimate.d, estimate.c, estimate.mu_c, estimate.theta, estimate.surprise
        contradiction = self._contenders.contradiction
        return ObjectEstimate((), np.zeros(0), (), -1, *known, contradiction, pose, covariance)
