# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The node that senses the object: control periods in, the estimate and the pose out."""

import math
from dataclasses import replace

import pytest
from geometry_msgs.msg import PoseWithCovarianceStamped
from sensor_msgs.msg import JointState

from support.node_bench import declared_topics
from tactile_push.control import PushLaw, Tick, tick_values
from tactile_push.interface import (
    ACTIVE_SENSING,
    CONTROLLER_STATE,
    OBJECT_POSE,
    SENSING_STATE,
    TOPICS,
)
from tactile_push.nodes.active_sensing import ActiveSensingNode
from tactile_push.nodes.ros.diagnostics import ERROR, OK, WARN
from tactile_push.nodes.ros.messages import filled
from tactile_push.nodes.ros.parameters import ConfigurationError
from tactile_push.pipeline.messages import joint_state_fields
from tactile_push.pipeline.stamps import stamp_of

DISK = {'disk_radius': 0.03}
TICK = Tick(
    *('pushing', '', 0.1, math.pi / 2.0, 0.0, 0.02, False, False, math.nan, 1, 0, 0.1, math.nan),
    psi=math.pi / 2.0,
)


def period(tick, sec=100, nanosec=0):
    """Return the controller's message of a control period."""
    values = tick_values(tick, PushLaw(0.05, 5.0, 0.0))
    return filled(JointState(), joint_state_fields((sec, nanosec), values))


def test_topics_are_those_of_the_interface(bench):
    bench.start(ActiveSensingNode, **DISK)
    assert bench.topics() == declared_topics(ACTIVE_SENSING)


def test_a_reading_gives_the_estimate_and_the_pose_when_it_was_read(bench):
    bench.start(ActiveSensingNode, **DISK)
    assert bench.health == (WARN, 'no control periods yet')
    bench.hear(JointState, SENSING_STATE)
    bench.hear(PoseWithCovarianceStamped, OBJECT_POSE)
    publisher = bench.publisher(JointState, CONTROLLER_STATE)

    publisher.publish(period(TICK))
    bench.until(lambda: bench.heard[OBJECT_POSE] and bench.heard[SENSING_STATE])

    assert tuple(bench.values(SENSING_STATE)) == TOPICS[SENSING_STATE].field_names
    assert bench.values(SENSING_STATE)['theta'] == pytest.approx(0.1)
    assert bench.values(SENSING_STATE)['readings'] == 1.0
    assert stamp_of(bench.heard[SENSING_STATE][0]) == (100, 0)
    assert stamp_of(bench.heard[OBJECT_POSE][0]) == (99, 980_000_000)
    # A disk's centre lies straight ahead of the contact, across both radii.
    place = bench.heard[OBJECT_POSE][0].pose.pose.position
    assert place.x == pytest.approx(-0.0435 * math.sin(0.1))
    assert place.y == pytest.approx(0.0435 * math.cos(0.1))
    assert bench.health == (OK, 'estimating')


def test_without_a_contact_there_is_no_pose(bench):
    bench.start(ActiveSensingNode, **DISK)
    bench.hear(JointState, SENSING_STATE)
    bench.hear(PoseWithCovarianceStamped, OBJECT_POSE)
    publisher = bench.publisher(JointState, CONTROLLER_STATE)
    publisher.publish(period(replace(TICK, theta=math.nan)))
    bench.until(lambda: bench.heard[SENSING_STATE])
    assert math.isnan(bench.values(SENSING_STATE)['theta'])
    assert bench.heard[OBJECT_POSE] == []
    assert bench.health == (WARN, 'nothing known: no contact')


def test_a_control_period_without_sense_is_counted_and_gives_nothing(bench):
    node = bench.start(ActiveSensingNode, **DISK)
    bench.hear(JointState, SENSING_STATE)
    publisher = bench.publisher(JointState, CONTROLLER_STATE)
    publisher.publish(JointState(name=['theta'], position=[0.1]))
    publisher.publish(period(TICK))
    bench.until(lambda: bench.heard[SENSING_STATE])
    assert node._counted['ticks without sense'] == 1
    assert node._counted['ticks'] == node._counted['readings'] == 1
    assert len(bench.heard[SENSING_STATE]) == 1


def test_readings_that_no_object_gives_are_an_error(bench):
    node = bench.start(ActiveSensingNode, **DISK)
    for k in range(80):
        tick = replace(TICK, theta=(0.9, -1.2, 0.2, -0.5)[k % 4], silence=0.0)
        node._on_tick(period(tick, 100 + k // 10, k % 10 * 100_000_000))
    level, words = bench.health
    assert level == ERROR
    assert words.startswith('nothing known: ')
    assert 'jump' in words


@pytest.mark.parametrize(
    ('without_psi', 'level', 'words'),
    [
        ('silent', ERROR, 'nothing known: the direction of the finger tip is unknown'),
        ('widen', WARN, 'hardly estimating: the direction of the finger tip is unknown'),
        ('straight', OK, 'estimating'),
    ],
)
def test_a_tip_whose_direction_is_not_known_is_told(bench, without_psi, level, words):
    node = bench.start(ActiveSensingNode, **DISK, without_psi=without_psi)
    node._on_tick(period(replace(TICK, psi=math.nan, silence=0.0)))
    assert bench.health[0] == level
    assert bench.health[1].startswith(words)


@pytest.mark.parametrize(
    ('parameters', 'refusal'),
    [
        ({'edge': 4}, 'parameter edge: expected -1 to 3, got 4'),
        ({'c_min': 0.03, 'c_max': 0.02}, 'parameter c_max: expected more than c_min = 0.03'),
        ({'vertices': [0.0, 1.0]}, 'parameter vertices: expected x and y of three corners'),
    ],
)
def test_an_object_that_is_none_is_refused(bench, parameters, refusal):
    with pytest.raises(ConfigurationError) as refused:
        bench.start(ActiveSensingNode, **parameters)
    assert str(refused.value).startswith(refusal)
