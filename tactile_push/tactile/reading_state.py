# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The fate of a reading as numbers with names, as it is published and recorded."""

from tactile_push.tactile.contact_finder import REFUSALS
from tactile_push.tactile.reading import Reading


def reading_values(
    reading: Reading, joint_angle: float, theta: float, refusal: str
) -> dict[str, float]:
    """Return all inputs and outputs of the contact geometry for one reading by name.

    Parameters
    ----------
    reading : Reading
        The sensor's angles [rad].
    joint_angle, theta : float
        By how far the joints had turned the finger tip at its moment, NaN if unknown, and angle of
        the pushed edge, NaN if the reading was refused [rad].
    refusal : str
        Why it was refused, one of `REFUSALS`.

    Returns
    -------
    dict of str to float
        The numbers by name.
    """
    return {
        'azimuth': reading.azimuth,
        'elevation': reading.elevation,
        'joint_angle': joint_angle,
        'theta': theta,
        'refusal': float(REFUSALS.index(refusal)),
    }
