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
"""What the finger pushes: a straight edge, or a disk whose tangent plays the edge's part.

An outline tells where the finger's disk touches it and where the object lies when it does.
Both use the contact coordinates (theta, s): the tangent's angle and the contact's position along
the outline. On an edge s is the paper's d; on a disk it is the arc from the point that lay at
theta = 0 when the object's own angle was 0.
"""

import math
from dataclasses import dataclass

PENETRATION = 1e-6  # what rounding may do to a contact [m]; deeper is beside or behind the edge


@dataclass(frozen=True)
class Pose:
    """Position of an object's centre of mass and its orientation.

    Parameters
    ----------
    x, y : float
        Position [m].
    angle : float
        Orientation [rad], counterclockwise.
    """

    x: float
    y: float
    angle: float


@dataclass(frozen=True)
class Edge:
    """A straight edge of an object.

    Parameters
    ----------
    length : float
        Length of the edge [m]; the point nearest the centre of mass is its middle.
    l : float
        Distance from the edge to the centre of mass [m].

    Raises
    ------
    ValueError
        If a length is not positive and finite.
    """

    length: float
    l: float

    curvature = 0.0

    def __post_init__(self) -> None:
        _check_length('length', self.length)
        _check_length('l', self.l)

    def d(self, s: float) -> float:
        """Give the paper's d of a contact.

        Parameters
        ----------
        s : float
            Contact along the outline [m].

        Returns
        -------
        float
            d [m]; on an edge it is s.
        """
        return s

    def bears(self, s: float) -> bool:
        """Tell whether the outline has a point at a place.

        Parameters
        ----------
        s : float
            Position along the outline [m].

        Returns
        -------
        bool
            Whether it lies on the edge.
        """
        return abs(s) <= self.length / 2.0

    def pose(self, theta: float, s: float, finger_x: float, finger_y: float, r: float) -> Pose:
        """Give the pose of the object that touches the finger's disk.

        Parameters
        ----------
        theta, s : float
            Angle of the edge [rad] and contact along it [m].
        finger_x, finger_y : float
            Centre of the finger's disk [m].
        r : float
            Radius of the finger's disk [m].

        Returns
        -------
        Pose
            Centre of mass and orientation.
        """
        sin, cos = math.sin(theta), math.cos(theta)
        reach = r + self.l
        return Pose(finger_x - reach * sin - s * cos, finger_y + reach * cos - s * sin, theta)

    def nearest(
        self, pose: Pose, finger_x: float, finger_y: float, r: float
    ) -> tuple[float, float, float]:
        """Find where the finger's disk is nearest to the edge.

        Parameters
        ----------
        pose : Pose
            Pose of the object.
        finger_x, finger_y : float
            Centre of the finger's disk [m].
        r : float
            Radius of the finger's disk [m].

        Returns
        -------
        theta, s : float
            Angle of the edge [rad] and position along it [m].
        gap : float
            Distance between disk and edge [m]; infinite beside and behind the edge.
        """
        sin, cos = math.sin(pose.angle), math.cos(pose.angle)
        x, y = finger_x - pose.x, finger_y - pose.y
        s, height = x * cos + y * sin, y * cos - x * sin
        gap = -height - self.l - r
        return pose.angle, s, gap if self.bears(s) and gap > -PENETRATION else math.inf


@dataclass(frozen=True)
class Disk:
    """A round object with its centre of mass in the middle.

    Parameters
    ----------
    radius : float
        Radius of the object [m].

    Raises
    ------
    ValueError
        If the radius is not positive and finite.
    """

    radius: float

    def __post_init__(self) -> None:
        _check_length('radius', self.radius)

    @property
    def l(self) -> float:
        """Distance from the tangent at the contact to the centre of mass [m]."""
        return self.radius

    @property
    def curvature(self) -> float:
        """Curvature of the outline [1/m]."""
        return 1.0 / self.radius

    def d(self, s: float) -> float:
        """Give the paper's d of a contact.

        Parameters
        ----------
        s : float
            Contact along the outline [m].

        Returns
        -------
        float
            0: the centre of mass lies on every normal.
        """
        return 0.0

    def bears(self, s: float) -> bool:
        """Tell whether the outline has a point at a place.

        Parameters
        ----------
        s : float
            Position along the outline [m].

        Returns
        -------
        bool
            True: the outline is closed.
        """
        return True

    def pose(self, theta: float, s: float, finger_x: float, finger_y: float, r: float) -> Pose:
        """Give the pose of the object that touches the finger's disk.

        Parameters
        ----------
        theta, s : float
            Angle of the tangent [rad] and contact along the outline [m].
        finger_x, finger_y : float
            Centre of the finger's disk [m].
        r : float
            Radius of the finger's disk [m].

        Returns
        -------
        Pose
            Centre and orientation.
        """
        reach = r + self.radius
        return Pose(
            finger_x - reach * math.sin(theta),
            finger_y + reach * math.cos(theta),
            theta - s / self.radius,
        )

    def nearest(
        self, pose: Pose, finger_x: float, finger_y: float, r: float
    ) -> tuple[float, float, float]:
        """Find where the finger's disk is nearest to the outline.

        Parameters
        ----------
        pose : Pose
            Pose of the object.
        finger_x, finger_y : float
            Centre of the finger's disk [m].
        r : float
            Radius of the finger's disk [m].

        Returns
        -------
        theta, s : float
            Angle of the tangent [rad] and position along the outline [m].
        gap : float
            Distance between disk and outline [m].
        """
        x, y = pose.x - finger_x, pose.y - finger_y
        theta = math.atan2(-x, y)
        return theta, (theta - pose.angle) * self.radius, math.hypot(x, y) - self.radius - r


Outline = Edge | Disk


def _check_length(name: str, value: float) -> None:
    if not (math.isfinite(value) and value > 0.0):
        raise ValueError(f'{name}: expected a positive length [m], got {value}')
