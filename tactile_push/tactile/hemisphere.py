# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From the sensor's two angles to the contact in the plane of motion, and back (Section V.A)."""

import math
from dataclasses import dataclass

from tactile_push.tactile.reading import Reading


class ReadingRejectedError(ValueError):
    """A reading from which no contact in the plane of motion follows; the message is the reason."""


@dataclass(frozen=True)
class Contact:
    """A contact on the finger's disk, in the frame `finger_disk`."""

    theta: float  #: angle of the pushed edge [rad], 90 degrees clockwise of the normal into it
    x: float  #: contact point relative to the disk's centre [m]
    y: float  #: the same [m]


def contact_of_reading(
    reading: Reading,
    psi: float,
    radius: float,
    max_out_of_plane: float,
    detectable_range: float = math.pi / 2.0,
) -> Contact:
    """Compute the contact from a reading.

    Parameters
    ----------
    reading : Reading
        The sensor's azimuth and elevation [rad].
    psi : float
        Angle of the finger tip's pole in `finger_base` [rad].
    radius : float
        Effective radius of the finger's disk [m].
    max_out_of_plane : float
        Bound on |cos(elevation) sin(azimuth)|, the part of the contact's direction that sticks
        out of the plane of motion: 0 for an upright face.
    detectable_range : float, optional
        Largest angle between the pole and a contact that the sensor detects properly [rad]; the
        whole hemisphere by default.

    Returns
    -------
    Contact
        theta and the contact point.

    Raises
    ------
    ReadingRejectedError
        If there is no contact, psi is not finite, an angle lies off the hemisphere, or the contact
        lies further from the pole or further out of the plane of motion than allowed. The message
        is the reason.

    References
    ----------
    K. M. Lynch, H. Maekawa and K. Tanie, "Manipulation and active sensing by pushing using
    tactile feedback", IROS 1992, Section V.A.
    """
    azimuth, elevation = reading.azimuth, reading.elevation
    if not math.isfinite(psi):
        raise ReadingRejectedError('direction of the finger unknown')
    if not reading.in_contact:
        raise ReadingRejectedError('no contact')
    if not (-math.pi <= azimuth <= math.pi and 0.0 <= elevation <= math.pi / 2.0):
        raise ReadingRejectedError('off the hemisphere')
    if not math.pi / 2.0 - elevation <= detectable_range:
        raise ReadingRejectedError('beyond the detectable range')
    if not abs(math.cos(elevation) * math.sin(azimuth)) <= max_out_of_plane:
        raise ReadingRejectedError('out of plane')
    left = math.cos(elevation) * math.cos(azimuth)
    normal_angle = psi + math.atan2(left, math.sin(elevation))
    theta = normalized_angle(normal_angle - math.pi / 2.0)
    return Contact(theta, radius * math.cos(normal_angle), radius * math.sin(normal_angle))


def reading_of_contact(theta: float, psi: float, normal_force: float = math.nan) -> Reading | None:
    """Find what the sensor reads at an upright face.

    Parameters
    ----------
    theta : float
        Angle of the pushed edge [rad].
    psi : float
        Angle of the finger tip's pole in `finger_base` [rad].
    normal_force : float, optional
        Force along the normal [N]; NaN where it is not measured.

    Returns
    -------
    Reading or None
        Azimuth and elevation [rad]; None if the contact lies behind the hemisphere.
    """
    from_pole = normalized_angle(theta + math.pi / 2.0 - psi)
    if abs(from_pole) > math.pi / 2.0:
        return None
    azimuth = 0.0 if from_pole >= 0.0 else math.pi
    return Reading(azimuth, math.pi / 2.0 - abs(from_pole), normal_force)


def normalized_angle(angle: float) -> float:
    """Bring an angle into [-pi, pi]; one that lies there stays as it is, to the bit."""
    return angle if -math.pi <= angle <= math.pi else math.remainder(angle, 2.0 * math.pi)
