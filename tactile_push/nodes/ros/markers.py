# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The rig as RViz shows it, in the frame `finger_disk`."""

import numpy as np
import numpy.typing as npt
from geometry_msgs.msg import Point, Vector3
from rclpy.time import Time
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

from tactile_push.pipeline.orientation import quaternion_of_yaw
from tactile_push.simulation import Rig

HEIGHT = 0.02  # of what stands on the belt [m]
SPACING = 0.002  # of points on curved outlines [m]
STEEL = ColorRGBA(r=0.55, g=0.60, b=0.68, a=1.0)
RUBBER = ColorRGBA(r=0.15, g=0.15, b=0.18, a=1.0)
BELT = ColorRGBA(r=0.80, g=0.78, b=0.70, a=1.0)
NORMAL = ColorRGBA(r=0.10, g=0.45, b=0.85, a=1.0)
CONE = ColorRGBA(r=0.95, g=0.70, b=0.10, a=1.0)
PUSH = ColorRGBA(r=0.85, g=0.15, b=0.15, a=1.0)


def rig_markers(rig: Rig, stamp: Time) -> MarkerArray:
    """Draw finger, object, belt and, in contact, the normal, friction cone and push ray.

    Parameters
    ----------
    rig : Rig
        The rig.
    stamp : Time
        Its time.

    Returns
    -------
    MarkerArray
        One namespace a thing.
    """
    pose = rig.object_in_finger_disk
    body = _marker(stamp, 'object', Marker.TRIANGLE_LIST, STEEL)
    body.pose.position.x, body.pose.position.y = pose.x, pose.y
    body.pose.orientation.z, body.pose.orientation.w = quaternion_of_yaw(pose.angle)
    body.scale = Vector3(x=1.0, y=1.0, z=1.0)
    body.points = _prism(rig.config.slider.outline.points(SPACING))
    finger = _marker(stamp, 'finger', Marker.SPHERE, RUBBER)
    finger.pose.position.z = HEIGHT / 2
    finger.scale = Vector3(
        x=2 * rig.config.radius, y=2 * rig.config.radius, z=2 * rig.config.radius
    )
    belt = _marker(stamp, 'belt', Marker.CUBE, BELT)
    belt.pose.position.z = -0.001
    belt.scale = Vector3(x=0.3, y=0.4, z=0.002)
    rays = [
        _marker(stamp, 'contact_normal', Marker.ARROW, NORMAL),
        _marker(stamp, 'friction_cone', Marker.LINE_LIST, CONE),
        _marker(stamp, 'push_ray', Marker.ARROW, PUSH),
    ]
    if rig.touching:
        direction = rig.contact_directions
        start = _point(direction['normal'], rig.config.radius)
        rays[0].points = [start, _point(direction['normal'], 0.04, start)]
        left, right = (_point(direction[side], 0.03, start) for side in ('left', 'right'))
        rays[1].points = [start, left, start, right]
        rays[2].points = [start, _point(direction['push'], 0.05, start)]
        for ray in rays:
            ray.scale = Vector3(x=0.0015, y=0.004, z=0.0)
    else:
        for ray in rays:
            ray.action = Marker.DELETE
    return MarkerArray(markers=[belt, body, finger, *rays])


def _marker(stamp: Time, namespace: str, kind: int, color: ColorRGBA) -> Marker:
    marker = Marker(ns=namespace, type=kind, action=Marker.ADD, color=color)
    marker.header.frame_id = 'finger_disk'
    marker.header.stamp = stamp.to_msg()
    marker.pose.orientation.w = 1.0
    return marker


def _prism(base: npt.NDArray[np.float64]) -> list[Point]:
    """Give the triangles of a convex prism on the belt, sides and top."""
    low = [Point(x=x, y=y, z=0.0) for x, y in base.tolist()]
    high = [Point(x=x, y=y, z=HEIGHT) for x, y in base.tolist()]
    triangles = []
    for i in range(len(base)):
        j = (i + 1) % len(base)
        triangles += [low[i], low[j], high[j], low[i], high[j], high[i], high[0], high[i], high[j]]
    return triangles


def _point(direction: tuple[float, float], length: float, start: Point | None = None) -> Point:
    origin = start or Point(z=HEIGHT / 2)
    return Point(x=origin.x + length * direction[0], y=origin.y + length * direction[1], z=origin.z)
