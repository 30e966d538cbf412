# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Objects that are placed on the rig, told the truth and by touch alone."""

import math

import pytest

from tactile_push.control import Limits
from tactile_push.control.placing.law import PlaceLaw
from tactile_push.control.placing.model import Goal
from tactile_push.control.placing.regrasp import Moves
from tactile_push.control.placing.stages import REGRASPING, RELEASED
from tactile_push.estimation import ActiveSensing, FingerMotion, ObjectEstimator, edges_of
from tactile_push.mechanics import Outline, Slider, Support
from tactile_push.mechanics.resistance import resistance
from tactile_push.paper import BLOCK_CORNERS, BLOCK_DEPTH, BLOCK_EDGE
from tactile_push.simulation import Rig, RigConfig, paper_block
from tactile_push.simulation.faults import Faults
from tactile_push.simulation.placement import place, pressure_of
from tactile_push.simulation.sensor import Sensor
from tactile_push.simulation.servo import Servo

LAG, NOISE = 0.1, math.radians(0.3)
BLOCK = Outline.rectangle(BLOCK_EDGE, BLOCK_DEPTH)


def law_for(config, shift, theta, belt=0.3):
    """Return a law whose goal lies aside of where the object is."""
    rig = Rig(config)
    x = rig.object_in_finger_disk.x + rig.finger_pose.x
    return PlaceLaw(Goal(x + shift, theta), belt, config.belt_speed, 0.1, lag=LAG)


@pytest.mark.parametrize('tip_turns', [False, True])
def test_an_object_is_placed_if_the_truth_is_told(tip_turns):
    block = paper_block(theta=0.2, d=0.003)
    config = RigConfig(block.slider, math.inf, 0.2, 0.003, tip_turns=tip_turns)
    law = law_for(config, -0.015, 0.0)
    found = place(Rig(config, Faults(servo=Servo(time_constant=LAG))), law)
    assert (found.stage, found.end) == (RELEASED, '')
    assert abs(found.x_error) < 2e-4
    assert abs(found.theta_error) < math.radians(0.2)
    assert found.learned == 0.0
    assert found.belt == law.used < 0.1


def placed_by_a_slow_lift(delay, lift_delay):
    """Place an object by a finger whose lift takes a time, of which the law is told another one."""
    block = paper_block(theta=0.2, d=0.003)
    rig = Rig(block, Faults(servo=Servo(time_constant=LAG, lift_delay=lift_delay)))
    x = rig.object_in_finger_disk.x + rig.finger_pose.x
    law = PlaceLaw(Goal(x - 0.015, 0.0), 0.3, block.belt_speed, 0.1, lag=LAG, delay=delay)
    return place(rig, law), rig.object_pose


def test_a_lift_that_takes_time_is_begun_so_much_earlier_if_the_law_is_told():
    (at_once, here), (told, _), (untold, there) = (
        placed_by_a_slow_lift(*one) for one in ((0.0, 0.0), (0.1, 0.1), (0.0, 0.1))
    )
    for found in (at_once, told, untold):
        assert (found.stage, found.end) == (RELEASED, '')
    for found in (at_once, told):
        assert abs(found.x_error) < 2e-4
        assert abs(found.theta_error) < math.radians(0.2)
    # Nobody told: the object is carried on for the belt of the lift, and passes the goal.
    assert there.y - here.y == pytest.approx(0.1 * 0.005, abs=1e-4)
    passed = untold.x_error - at_once.x_error, untold.theta_error - at_once.theta_error
    assert abs(passed[0]) > 1e-4 or abs(passed[1]) > math.radians(0.2)


@pytest.mark.slow
def test_an_object_is_placed_by_touch_alone():
    slider = Slider.on(BLOCK, Support.corners(BLOCK), exact=True)
    config = RigConfig(slider, 0.5, 0.2, 0.003, tip_turns=False)
    law = law_for(config, -0.02, -0.1)
    estimator = ObjectEstimator(edges_of(BLOCK_CORNERS)[:1], NOISE, l_share=0.01, radius_share=0.01)
    sensing = ActiveSensing(estimator, FingerMotion(LAG), config.belt_speed, 0.3)
    faults = Faults(servo=Servo(time_constant=LAG), sensor=Sensor(NOISE))
    found = place(Rig(config, faults), law, sensing=sensing)
    assert (found.stage, found.end) == (RELEASED, '')
    assert abs(found.x_error) < 5e-4
    assert abs(found.theta_error) < math.radians(0.5)
    assert 0.0 < found.learned < found.belt


def test_an_object_that_hardly_turns_resists_by_the_moment_of_its_load_along_its_way():
    slider = Slider.on(BLOCK, Support.corners(BLOCK), exact=True)
    for tangent, along in ((0.0, BLOCK_EDGE), (math.pi / 2.0, BLOCK_DEPTH)):
        found = pressure_of(slider, tangent)
        assert resistance(1.0, 0.0, 0.0, found) == pytest.approx(along**2 / 4.0)
    assert pressure_of(paper_block(c=0.02).slider)[:2] == pytest.approx((4e-4, 0.0))


@pytest.mark.parametrize(
    ('bearing', 'within'),
    [
        (Support.uniform(BLOCK, 400), 0.15),  # one of whose points is at the centre
        (Support.circle(0.01, count=400), 0.15),
        (Support.rim(BLOCK, 400), 0.15),
        (Support.corners(BLOCK), 0.4),
    ],
)
def test_an_object_that_turns_resists_much_as_on_the_exact_limit_surface(bearing, within):
    slider = Slider.on(BLOCK, bearing, exact=True)
    found = pressure_of(slider)
    for turn in (0.1, 0.3, 0.5):
        omega = turn / math.sqrt(found.c_squared)
        for way in (0.0, 0.5, -0.8):
            v_x, v_y = math.sin(way), math.cos(way)
            f_x, f_y, m = slider.wrench((v_x, v_y, omega))
            exact = m / math.hypot(f_x, f_y) / omega
            assert resistance(v_x, v_y, omega, found) == pytest.approx(exact, rel=within)


MOVES, ROOM = Moves(0.02, 0.05, 0.005), 0.05


def regrasping(theta, d, shift, belt, support=None):
    """Return a rig and a law with two axes whose goal no push from the first contact reaches."""
    slider = paper_block().slider
    if support is not None:
        slider = Slider.on(BLOCK, support(BLOCK), exact=True)
    config = RigConfig(slider, math.inf, theta, d, tip_turns=False)
    one = law_for(config, shift, theta, belt)
    two = PlaceLaw(*(one.goal, belt, config.belt_speed, 0.1), lag=LAG, moves=MOVES, room=ROOM)
    return config, one, two


def test_a_finger_of_two_axes_places_what_sticking_excludes():
    config, one, two = regrasping(0.35, 0.012, 0.015, 0.2)
    faults, limits = Faults(servo=Servo(time_constant=LAG)), Limits(retreat_max=ROOM)
    assert place(Rig(config, faults), one).stage != RELEASED
    rig, stages = Rig(config, faults), []

    def watch(rig, tick):
        stages.append(two.stage)
        assert tick.apart == (two.stage == REGRASPING)

    found = place(rig, two, limits=limits, watch=watch)
    assert (found.stage, found.end, two.regrasps) == (RELEASED, '', 1)
    assert abs(found.x_error) < 2e-4
    assert abs(found.theta_error) < math.radians(0.2)
    assert -ROOM < rig.along < -0.002
    assert REGRASPING in stages


@pytest.mark.slow
def test_what_was_learnt_before_is_known_after_the_second_touch():
    config, _, law = regrasping(0.35, 0.012, 0.015, 0.3, Support.corners)
    estimator = ObjectEstimator(edges_of(BLOCK_CORNERS)[:1], NOISE, l_share=0.01, radius_share=0.01)
    sensing = ActiveSensing(estimator, FingerMotion(LAG), config.belt_speed, 0.3)
    faults = Faults(servo=Servo(time_constant=LAG), sensor=Sensor(NOISE))
    known = []

    def watch(rig, tick):
        now = estimator.estimate()
        known.append((tick.apart, rig.d - now.d.mean, now.d.upper - now.d.lower, sensing.readings))

    found = place(
        Rig(config, faults),
        law,
        sensing=sensing,
        limits=Limits(retreat_max=ROOM),
        watch=watch,
    )
    assert found.stage == RELEASED
    assert law.regrasps >= 1
    assert abs(found.x_error) < 1e-3
    assert abs(found.theta_error) < math.radians(1.0)
    last = max(k for k, one in enumerate(known) if one[0])
    _, error, width, readings = known[last + 3]
    assert readings > 20  # nothing was forgotten
    assert width < 4e-3
    assert abs(error) < width
