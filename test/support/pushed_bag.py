# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A bag of a run that is known in closed form, for tests of what is made of it."""

import json
import math

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
from rclpy.serialization import serialize_message
from sensor_msgs.msg import JointState

from tactile_push.bags import BagReader, BagWriter
from tactile_push.report import read_run

START = 1_700_000_000_000_000_000  # 2023-11-14 22:13:20 UTC [ns]
DURATION = 12.0
R, L, D = 0.0135, 0.02375, 0.002  # finger's radius, edge to centre of mass, contact [m]
THETA_D = math.radians(-10.0)
SILENT = 6.0, 7.0  # the contact is silent and the finger stops
REFUSED = 3.0, 3.1  # readings are refused
PUSHING, STOPPED = 2.0, 3.0
CONTACT_SILENT, OUT_OF_PLANE = 1.0, 8.0  # indices of the reasons, as the README has them
HOSTILE = '</script><script>window.hacked = 1</script><img src=x onerror="window.hacked = 1">'
JOINTS, POSE = 'sensor_msgs/msg/JointState', 'geometry_msgs/msg/PoseStamped'
PARAMETERS = {
    'sim_plant': {
        'object': 'block',
        'edge_length': 0.05,
        'edge_to_cm': L,
        'mu_c': 0.3,
        'finger_radius': R,
    },
    'push_controller': {'kp': 0.05, 'note': HOSTILE},
}


def theta(t):
    """Return the edge's angle [rad]."""
    return math.radians(20.0 - 2.0 * t)


def phi(t):
    """Return the push angle [rad]."""
    return math.radians(90.0 + 8.0 * math.sin(t))


def centre(t):
    """Return the centre of mass in `finger_disk` [m]: r n - d t + l n from the finger's centre."""
    normal = theta(t) + math.pi / 2.0
    return (
        (R + L) * math.cos(normal) - D * math.cos(theta(t)),
        (R + L) * math.sin(normal) - D * math.sin(theta(t)),
    )


def stamped(message, t):
    """Give a message its stamp."""
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(
        START + round(t * 1e9), 1_000_000_000
    )
    return message


def joint_state(t, **values):
    """Return the message in CDR."""
    positions = [float(value) for value in values.values()]
    return serialize_message(stamped(JointState(name=list(values), position=positions), t))


def pose(t, x, y, yaw):
    """Return the message in CDR."""
    message = stamped(PoseStamped(), t)
    message.pose.position.x, message.pose.position.y = x, y
    message.pose.orientation.z, message.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return serialize_message(message)


def estimated_pose(t, x, y):
    """Return the message in CDR."""
    message = stamped(PoseWithCovarianceStamped(), t)
    message.pose.pose.position.x, message.pose.pose.position.y = x, y
    message.pose.pose.orientation.w = 1.0
    return serialize_message(message)


def diagnostics(t, name, level, text):
    """Return the message in CDR."""
    message = stamped(DiagnosticArray(), t)
    message.status = [DiagnosticStatus(level=level, name=name, message=text)]
    return serialize_message(message)


def messages(t, tick, truth=True):
    """Yield topic, type and CDR of what is said at a moment."""
    silent = SILENT[0] <= t < SILENT[1]
    refused = REFUSED[0] <= t < REFUSED[1]
    yield 'tactile', JOINTS, joint_state(t, azimuth=0.0, elevation=1.5)
    refusal = OUT_OF_PLANE if refused else 0.0
    yield 'contact_geometry/state', JOINTS, joint_state(t, theta=theta(t), refusal=refusal)
    normal = theta(t) + math.pi / 2.0
    if not (silent or refused):
        yield 'contact', POSE, pose(t, R * math.cos(normal), R * math.sin(normal), theta(t))
    if truth:
        yield 'ground_truth/object_pose', POSE, pose(t, *centre(t), theta(t))
        yield (
            'ground_truth/state',
            JOINTS,
            joint_state(t, theta=theta(t), d=D, v_x=0.001, belt_travel=0.005 * t),
        )
    if tick:
        yield (
            'push_controller/state',
            JOINTS,
            joint_state(
                t,
                theta=math.nan if silent else theta(t),
                theta_desired=THETA_D,
                phi=phi(t),
                v_x=0.0 if silent else 0.001,
                silence=t - SILENT[0] if silent else 0.02,
                saturated=0.0,
                limited=0.0,
                finger_x=0.01 * t / DURATION,
                state=STOPPED if silent else PUSHING,
                stop_reason=CONTACT_SILENT if silent else 0.0,
                ticks=t * 10.0,
                ticks_lost=0.0,
            ),
        )


def write_bag(folder, namespace='', truth=True, parameters=PARAMETERS):
    """Write the bag and return its folder."""
    topics = set()
    with BagWriter(folder) as bag:
        if parameters is not None:
            bag.note('tactile_push.parameters', json.dumps(parameters))
            bag.note('tactile_push.version', '1.2.3')
        bag.add_topic('/diagnostics', 'diagnostic_msgs/msg/DiagnosticArray')
        for k in range(int(DURATION * 50) + 1):
            t = k / 50.0
            now = START + k * 20_000_000
            for own, kind, data in messages(t, k % 5 == 0, truth):
                topic = f'{namespace}/{own}'
                if topic not in topics:
                    topics.add(topic)
                    bag.add_topic(topic, kind)
                bag.write(topic, data, now, now)
            if k % 50 == 0:
                warned = 8.0 <= t < 10.0
                level = DiagnosticStatus.WARN if warned else DiagnosticStatus.OK
                status = diagnostics(t, 'sensor_driver', level, HOSTILE if warned else 'fine')
                bag.write('/diagnostics', status, now, now)
    return folder


def run_of(folder):
    """Return what a report makes of a bag."""
    with BagReader(folder) as bag:
        return read_run(bag)


def written(folder, *messages):
    """Write a bag of (topic, type, time [s], CDR)."""
    with BagWriter(folder) as bag:
        for topic, kind in dict.fromkeys((topic, kind) for topic, kind, _, _ in messages):
            bag.add_topic(topic, kind)
        for topic, _, t, data in messages:
            now = START + round(t * 1e9)
            bag.write(topic, data, now, now)
    return folder


def sensing_bag(folder, widths, contradictions):
    """Write a bag of control periods and how wide the 95 % interval of d was in each [m]."""
    rows = []
    for k, (width, contradiction) in enumerate(zip(widths, contradictions, strict=True)):
        t = 0.1 * k
        values = {'theta': 0.1, 'theta_desired': math.radians(-10.0), 'phi': 1.5, 'state': 2.0}
        rows.append(('/push_controller/state', JOINTS, t, joint_state(t, **values)))
        bounds = {'d_lower': -width / 2, 'd_upper': width / 2, 'd_least': -0.025, 'd_most': 0.025}
        sensed = joint_state(t, d=0.0, **bounds, contradiction=contradiction)
        rows.append(('/active_sensing/state', JOINTS, t, sensed))
    return written(folder, *rows)
