# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Kinematics of a finger that one prismatic joint moves across the belt."""

from collections.abc import Sequence


class LinearAxis:
    """One joint along x of `finger_base`, where the disk's centre is at the joint's position."""

    def centre(self, joints: Sequence[float]) -> tuple[float, float]:
        """Find the disk's centre.

        Parameters
        ----------
        joints : sequence of float
            Position of the joint [m].

        Returns
        -------
        x, y : float
            Centre of the disk in `finger_base` [m].
        """
        return joints[0], 0.0

    def levers(self, joints: Sequence[float]) -> tuple[tuple[float, float], ...]:
        """Find how the disk's centre moves with the joint.

        Parameters
        ----------
        joints : sequence of float
            Position of the joint [m], which does not matter.

        Returns
        -------
        tuple of (float, float)
            x and y [m/m] of the only joint.
        """
        return ((1.0, 0.0),)

    def manipulability(self, joints: Sequence[float]) -> float:
        """Find how far the finger is from a pose in which it cannot move across the belt.

        Parameters
        ----------
        joints : sequence of float
            Position of the joint [m], which does not matter.

        Returns
        -------
        float
            1, the largest: an axis has no such pose.
        """
        return 1.0

    def moved(self, before: Sequence[float], after: Sequence[float]) -> tuple[float, ...]:
        """Find how far the joint has moved.

        Parameters
        ----------
        before, after : sequence of float
            Positions of the joint [m].

        Returns
        -------
        tuple of float
            Way of the only joint [m].
        """
        return (after[0] - before[0],)
