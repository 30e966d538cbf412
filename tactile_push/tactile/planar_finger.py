# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Kinematics of the planar finger (Section V.A): first joint fixed, two joints move."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass


class OutOfReachError(ValueError):
    """A place that the finger cannot reach."""


@dataclass(frozen=True)
class FingerPose:
    """Pose of the finger tip in `finger_base`."""

    x: float  #: centre of the finger's disk [m]
    y: float  #: the same [m]
    psi: float  #: angle of the finger tip's pole [rad]


@dataclass(frozen=True)
class PlanarFinger:
    """Two links in the plane of motion.

    The first moving joint is the origin of `finger_base`. The second link ends at the centre of
    the finger's disk and points along the finger tip's pole.

    Raises
    ------
    ValueError
        If a length is not positive or a number is not finite.
    """

    proximal_length: float  #: between the two moving joints [m]
    distal_length: float  #: from the second moving joint to the centre of the disk [m]
    mount_angle: float  #: of the finger at joint angles zero [rad], as the fixed joint leaves it

    def __post_init__(self) -> None:
        for name in ('proximal_length', 'distal_length'):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0.0):
                raise ValueError(f'{name}: expected a positive length [m], got {value}')
        if not math.isfinite(self.mount_angle):
            raise ValueError(f'mount_angle: expected an angle [rad], got {self.mount_angle}')

    def forward(self, proximal: float, distal: float) -> FingerPose:
        """Find the finger tip's pose at given joint angles.

        Parameters
        ----------
        proximal, distal : float
            Joint angles [rad], counterclockwise.

        Returns
        -------
        FingerPose
            Centre of the disk and angle of the pole.
        """
        knuckle = self.mount_angle + proximal
        psi = pole_angle(self.mount_angle, (proximal, distal))
        return FingerPose(
            self.proximal_length * math.cos(knuckle) + self.distal_length * math.cos(psi),
            self.proximal_length * math.sin(knuckle) + self.distal_length * math.sin(psi),
            psi,
        )

    def inverse(self, x: float, y: float) -> tuple[float, float]:
        """Find the joint angles that bring the disk's centre to a place.

        Of the two solutions it is the one with the second joint bent clockwise, so that the
        knuckle stays to the left of the belt.

        Parameters
        ----------
        x, y : float
            Centre of the disk in `finger_base` [m].

        Returns
        -------
        proximal, distal : float
            Joint angles [rad].

        Raises
        ------
        OutOfReachError
            If the finger does not reach the place.
        """
        a, b = self.proximal_length, self.distal_length
        knuckle, distal = link_angles(x, y, a, b)
        if math.isnan(distal):
            raise OutOfReachError(
                f'the finger reaches {abs(a - b):.4f} to {a + b:.4f} m from its joint, '
                f'not ({x:.4f}, {y:.4f}) m'
            )
        return math.remainder(knuckle - self.mount_angle, 2.0 * math.pi), distal

    def turning(self, proximal: float, distal: float) -> float:
        """Find by how much the tip turns for each metre across the belt, dpsi/dx with y held.

        With the directions k of the first link and psi of the second, and their lengths a and b,

            dx = -a sin k dk - b sin psi dpsi,    0 = dy = a cos k dk + b cos psi dpsi.

        Without dk this is cos k dx = b sin(k - psi) dpsi. The sign is that of cos k for a second
        joint bent clockwise: a knuckle left of the first joint turns the tip clockwise on its way
        to the right, and one right of it counterclockwise.

        Parameters
        ----------
        proximal, distal : float
            Joint angles [rad].

        Returns
        -------
        float
            dpsi/dx [rad/m]; infinite where the finger is stretched or folded, and cannot move
            across the belt alone.
        """
        along = math.cos(self.mount_angle + proximal)
        across = -self.distal_length * math.sin(distal)
        return along / across if across != 0.0 else math.copysign(math.inf, along)

    def line(self, joints: Sequence[float]) -> tuple[float, float]:
        """Find on which line across the belt given joints keep the disk, and how they are bent.

        With these two and the lengths of the links the tip's direction follows from x alone.

        Parameters
        ----------
        joints : sequence of float
            Angles of the two moving joints and, if it has one, of the wrist that holds the tip
            straight [rad].

        Returns
        -------
        y : float
            Centre of the disk along the belt, in `finger_base` [m].
        bend : float
            Where the second link is bent to from the first: 1 counterclockwise, -1 clockwise; 0 if
            the tip does not turn with it.
        """
        proximal, distal, *wrist = joints
        bend = 0.0 if wrist else math.copysign(1.0, math.sin(distal))
        return self.forward(proximal, distal).y, bend

    def centre(self, joints: Sequence[float]) -> tuple[float, float]:
        """Find the disk's centre at given joint angles.

        Parameters
        ----------
        joints : sequence of float
            Joint angles [rad].

        Returns
        -------
        x, y : float
            Centre of the disk in `finger_base` [m].
        """
        pose = self.forward(*joints)
        return pose.x, pose.y

    def levers(self, joints: Sequence[float]) -> tuple[tuple[float, float], ...]:
        """Find the columns of the Jacobian: how the disk's centre moves as each joint turns.

        A joint turns everything beyond it, so its column is the way from the joint to the centre,
        turned by 90 degrees.

        Parameters
        ----------
        joints : sequence of float
            Joint angles [rad].

        Returns
        -------
        tuple of (float, float)
            x and y [m/rad] of each joint.
        """
        x, y = self.centre(joints)
        psi = pole_angle(self.mount_angle, joints)
        along, across = self.distal_length * math.cos(psi), self.distal_length * math.sin(psi)
        return (-y, x), (-across, along)

    def manipulability(self, joints: Sequence[float]) -> float:
        """Find how far the finger is from stretched and folded, where it cannot move in one way.

        The determinant of the Jacobian is a b sin(distal).

        Parameters
        ----------
        joints : sequence of float
            Joint angles [rad].

        Returns
        -------
        float
            Its size relative to the largest, 0 to 1.

        References
        ----------
        T. Yoshikawa, "Manipulability of robotic mechanisms", IJRR 4(2), 1985.
        """
        return abs(math.sin(joints[1]))

    def moved(self, before: Sequence[float], after: Sequence[float]) -> tuple[float, ...]:
        """Find how far the joints have turned, the shorter way around.

        Parameters
        ----------
        before, after : sequence of float
            Joint angles [rad], which may be reported in (-pi, pi].

        Returns
        -------
        tuple of float
            Angle of each joint [rad].
        """
        pairs = zip(before, after, strict=True)
        return tuple(math.remainder(end - start, 2.0 * math.pi) for start, end in pairs)


# Of rig and nodes unless somebody gives another, straight ahead. The lengths are picked.
USUAL_FINGER = PlanarFinger(0.06, 0.08, math.pi / 2.0)


def link_angles(x: float, y: float, a: float, b: float) -> tuple[float, float]:
    """Find the directions of two links, the second bent clockwise, that reach a place.

    Parameters
    ----------
    x, y : float
        The place, from where the first link begins [m].
    a, b : float
        Lengths of the links [m].

    Returns
    -------
    knuckle, distal : float
        Direction of the first link, and of the second one from there [rad]; NaN where they do not
        reach.
    """
    bend = (x**2 + y**2 - a**2 - b**2) / (2.0 * a * b)
    if not abs(bend) <= 1.0:
        return math.nan, math.nan
    distal = -math.acos(bend)
    return math.atan2(y, x) - math.atan2(b * math.sin(distal), a + b * math.cos(distal)), distal


def pole_angle(mount_angle: float, joint_angles: Iterable[float]) -> float:
    """Return psi, the angle of the finger tip's pole in `finger_base` [rad]."""
    return mount_angle + sum(joint_angles)
