# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Draws what is known of the object, beside the truth that the simulated plant draws."""

import math

import numpy as np
import numpy.typing as npt
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Point, Vector3
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

from tactile_push.estimation import ObjectEstimate, centre_on_ray
from tactile_push.interface import FINGER_DISK
from tactile_push.pipeline.orientation import quaternion_of_yaw

ABOVE = 0.022  # the belt, so that it is seen beside the true object [m]
CORNERS = 72  # of a drawn circle
GUESS = ColorRGBA(r=0.10, g=0.60, b=0.30, a=1.0)
SURE = ColorRGBA(r=0.10, g=0.60, b=0.30, a=0.4)


def estimate_markers(
    estimate: ObjectEstimate | None,
    vertices: npt.NDArray[np.float64] | None,
    disk_radius: float,
    finger_radius: float,
    stamp: Time,
) -> MarkerArray:
    """Draw the outline where it is thought to be, and where the centre of mass may be.

    Parameters
    ----------
    estimate : ObjectEstimate or None
        What is known; None clears the drawing.
    vertices : ndarray, shape (N, 2), or None
        Corners of the object from its centre of mass [m]; None if it is round.
    disk_radius : float
        Radius of a round object [m].
    finger_radius : float
        Effective radius of the finger's disk [m].
    stamp : Time
        Time of the estimate.

    Returns
    -------
    MarkerArray
        `outline`, and the centre of mass as far as d is known: `likely` by the 95 % interval,
        `possible` by the guaranteed one.
    """
    outline = _marker(stamp, 'outline', Marker.LINE_STRIP, GUESS, 0.001)
    likely = _marker(stamp, 'likely', Marker.LINE_STRIP, GUESS, 0.003)
    possible = _marker(stamp, 'possible', Marker.LINE_STRIP, SURE, 0.0015)
    markers = [outline, likely, possible]
    if estimate is None:
        for marker in markers:
            marker.action = Marker.DELETE
        return MarkerArray(markers=markers)
    x, y, angle = estimate.pose.tolist()
    outline.pose.position.x, outline.pose.position.y = x, y
    outline.pose.orientation.z, outline.pose.orientation.w = quaternion_of_yaw(angle)
    if vertices is None:
        turns = np.linspace(0.0, 2.0 * math.pi, CORNERS)
        vertices = disk_radius * np.stack([np.cos(turns), np.sin(turns)], axis=1)
    outline.points = [_point(x, y) for x, y in [*vertices.tolist(), vertices[0].tolist()]]
    l = math.hypot(x, y) if not estimate.edges else estimate.edges[estimate.edge].l
    for marker, ends in (
        (likely, (estimate.d.lower, estimate.d.upper)),
        (possible, (estimate.d.least, estimate.d.most)),
    ):
        marker.points = [_point(*centre_on_ray(estimate.theta, d, l, finger_radius)) for d in ends]
    return MarkerArray(markers=markers)


def _marker(stamp: Time, namespace: str, kind: int, color: ColorRGBA, width: float) -> Marker:
    marker = Marker(ns=namespace, type=kind, action=Marker.ADD, color=color)
    marker.header.frame_id = FINGER_DISK
    marker.header.stamp = stamp
    marker.pose.orientation.w = 1.0
    marker.scale = Vector3(x=width)
    return marker


def _point(x: float, y: float) -> Point:
    return Point(x=x, y=y, z=ABOVE)
