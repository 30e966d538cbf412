# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What RViz shows in `finger_disk`: the simulated rig, and what is known of the object."""

from typing import TYPE_CHECKING

import numpy as np
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Point, Vector3
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

from tactile_push.estimation import ObjectEstimate, centre_on_ray
from tactile_push.interface import FINGER_DISK
from tactile_push.mechanics import Outline
from tactile_push.mechanics.compiled import Array
from tactile_push.parameters import ActiveSensingParameters
from tactile_push.pipeline.orientation import quaternion_of_yaw
from tactile_push.simulation import Rig

if TYPE_CHECKING:
    from tactile_push.simulation.mujoco_rig import MujocoRig

HEIGHT = 0.02  # of what stands on the belt [m]; picked, as all sizes and colours here
ABOVE = 0.022  # height of an estimate, so that it is seen beside the true object [m]
LIFTED = 0.06  # height of the centre of a lifted finger [m]
SPACING = 0.002  # of points on curved outlines [m]
STEEL = ColorRGBA(r=0.55, g=0.60, b=0.68, a=1.0)
RUBBER = ColorRGBA(r=0.15, g=0.15, b=0.18, a=1.0)
BELT = ColorRGBA(r=0.80, g=0.78, b=0.70, a=1.0)
NORMAL = ColorRGBA(r=0.10, g=0.45, b=0.85, a=1.0)
CONE = ColorRGBA(r=0.95, g=0.70, b=0.10, a=1.0)
PUSH = ColorRGBA(r=0.85, g=0.15, b=0.15, a=1.0)
GUESS = ColorRGBA(r=0.10, g=0.60, b=0.30, a=1.0)
SURE = ColorRGBA(r=0.10, g=0.60, b=0.30, a=0.4)


def rig_markers(rig: 'Rig | MujocoRig', stamp: Time) -> MarkerArray:
    """Draw finger, object, belt and, in contact, the normal, friction cone and push ray."""
    pose = rig.object_in_finger_disk
    body = _marker(stamp, 'object', Marker.TRIANGLE_LIST, STEEL, (1.0, 1.0, 1.0))
    _place(body, pose.x, pose.y, pose.angle)
    body.points = _prism(rig.config.slider.outline.points(SPACING))
    finger = _marker(stamp, 'finger', Marker.SPHERE, RUBBER, (2.0 * rig.config.radius,) * 3)
    finger.pose.position.z = LIFTED if rig.lifted else HEIGHT / 2
    belt = _marker(stamp, 'belt', Marker.CUBE, BELT, (0.3, 0.4, 0.002))
    belt.pose.position.z = -0.001
    normal, cone, push = rays = [
        _marker(stamp, 'contact_normal', Marker.ARROW, NORMAL, (0.0015, 0.004, 0.0)),
        _marker(stamp, 'friction_cone', Marker.LINE_LIST, CONE, (0.0015, 0.004, 0.0)),
        _marker(stamp, 'push_ray', Marker.ARROW, PUSH, (0.0015, 0.004, 0.0)),
    ]
    if rig.touching:
        direction = rig.contact_directions
        start = _point(direction['normal'], rig.config.radius, Point(z=HEIGHT / 2))
        left, right = (_point(direction[side], 0.03, start) for side in ('left', 'right'))
        normal.points = [start, _point(direction['normal'], 0.04, start)]
        cone.points = [start, left, start, right]
        push.points = [start, _point(direction['push'], 0.05, start)]
    else:
        for ray in rays:
            ray.action = Marker.DELETE
    return MarkerArray(markers=[belt, body, finger, *rays])


def estimate_markers(
    estimate: ObjectEstimate | None, p: ActiveSensingParameters, stamp: Time
) -> MarkerArray:
    """Draw the outline at its estimated pose, and where the centre of mass may be.

    `likely` shows the centre of mass along the 95 % interval of d, `possible` along the guaranteed
    one. Without an estimate the drawing is cleared.
    """
    outline = _marker(stamp, 'outline', Marker.LINE_STRIP, GUESS, (0.001, 0.0, 0.0))
    likely = _marker(stamp, 'likely', Marker.LINE_STRIP, GUESS, (0.003, 0.0, 0.0))
    possible = _marker(stamp, 'possible', Marker.LINE_STRIP, SURE, (0.0015, 0.0, 0.0))
    markers = [outline, likely, possible]
    if estimate is None:
        for marker in markers:
            marker.action = Marker.DELETE
        return MarkerArray(markers=markers)
    _place(outline, *estimate.pose.tolist())
    if estimate.edges:
        corners, l = np.reshape(p.vertices, (-1, 2)), estimate.edges[estimate.edge].l
    else:
        corners, l = Outline.circle(p.disk_radius).points(SPACING), p.disk_radius
    outline.points = [Point(x=x, y=y, z=ABOVE) for x, y in [*corners.tolist(), corners[0].tolist()]]
    for marker, ends in (
        (likely, (estimate.d.lower, estimate.d.upper)),
        (possible, (estimate.d.least, estimate.d.most)),
    ):
        for d in ends:
            x, y = centre_on_ray(estimate.theta, d, l, p.finger_radius)
            marker.points.append(Point(x=x, y=y, z=ABOVE))
    return MarkerArray(markers=markers)


def _marker(
    stamp: Time, namespace: str, kind: int, color: ColorRGBA, size: tuple[float, float, float]
) -> Marker:
    marker = Marker(ns=namespace, type=kind, action=Marker.ADD, color=color)
    marker.header.frame_id, marker.header.stamp = FINGER_DISK, stamp
    marker.scale = Vector3(x=size[0], y=size[1], z=size[2])
    marker.pose.orientation.w = 1.0
    return marker


def _place(marker: Marker, x: float, y: float, angle: float) -> None:
    marker.pose.position.x, marker.pose.position.y = x, y
    marker.pose.orientation.z, marker.pose.orientation.w = quaternion_of_yaw(angle)


def _prism(base: Array) -> list[Point]:
    """Return the triangles of a convex prism on the belt, sides and top."""
    low = [Point(x=x, y=y, z=0.0) for x, y in base.tolist()]
    high = [Point(x=x, y=y, z=HEIGHT) for x, y in base.tolist()]
    triangles = []
    for i in range(len(base)):
        j = (i + 1) % len(base)
        triangles += [low[i], low[j], high[j], low[i], high[j], high[i], high[0], high[i], high[j]]
    return triangles


def _point(direction: tuple[float, float], length: float, start: Point) -> Point:
    return Point(x=start.x + length * direction[0], y=start.y + length * direction[1], z=start.z)
