# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.mechanics import SLIP_RIGHT, STICK, Finger, friction_cone, move_finger
from tactile_push.simulation import (
    Belt,
    Faults,
    Rig,
    Servo,
    UnevenFriction,
    Workspace,
    paper_block,
    paper_disk,
)

PROPERTY = settings(derandomize=True, deadline=None, max_examples=30)
V_Y = 0.005
HOME = -0.06  # x of the finger at its start: the knuckle is one proximal link to the left
commands = st.lists(st.floats(-0.008, 0.008), min_size=1, max_size=12)


def state(rig):
    """Return all that moves."""
    return (*rig.object_pose, rig.sigma, rig.finger_x, rig.finger_y)


@given(commands, st.sampled_from([0.0, 0.3, math.inf]), st.sampled_from([0.02, 0.1]))
@PROPERTY
def test_rig_without_faults_is_one_push_a_step_to_the_bit(velocities, mu_c, duration):
    config = paper_block(mu_c=mu_c)
    rig = Rig(config)
    body = config.slider.body(config.radius)
    finger = Finger(*friction_cone(mu_c), config.radius)
    pose, sigma, touching, x_f, y_f = rig.object_pose, rig.sigma, True, 0.0, 0.0
    for v_x in velocities:
        rig.step(v_x, duration)
        pose, sigma, touching, mode = move_finger(
            pose, sigma, touching, x_f, y_f, v_x, V_Y, duration, body, finger
        )
        x_f, y_f = x_f + v_x * duration, y_f + V_Y * duration
        assert state(rig) == (*pose, sigma, x_f, y_f)
        assert (rig.mode, rig.touching, rig.v_x) == (mode, touching, v_x)


@pytest.mark.parametrize('paper', [paper_block, paper_disk])
@pytest.mark.parametrize(
    'faults',
    [
        Faults(servo=Servo(time_constant=0.1)),
        Faults(servo=Servo(time_constant=0.03, delay=0.07)),
        Faults(belt=Belt(0.5, 3.0)),
        Faults(friction=UnevenFriction(0.9, 0.003)),
        Faults(Servo(0.05, 0.02, 1e-4), belt=Belt(0.3, 1.0), friction=UnevenFriction(0.5, 0.004)),
    ],
    ids=['lag', 'lag and delay', 'belt', 'friction', 'all'],
)
def test_one_step_is_as_good_as_fifty(paper, faults):
    coarse, fine = Rig(paper(mu_c=0.2), faults), Rig(paper(mu_c=0.2), faults)
    for k in range(30):
        v_x = 0.004 * math.sin(0.5 * k)
        coarse.step(v_x, 0.1)
        for _ in range(50):
            fine.step(v_x, 0.002)
    assert coarse.theta == pytest.approx(fine.theta, abs=2e-4)
    assert state(coarse) == pytest.approx(state(fine), abs=2e-4)
    assert coarse.finger_x == pytest.approx(fine.finger_x, abs=1e-8)
    assert coarse.finger_y == pytest.approx(fine.finger_y, abs=1e-8)
    assert coarse.v_x == pytest.approx(fine.v_x, abs=1e-8)
    assert coarse.time == pytest.approx(fine.time)


def test_lagging_finger_moves_as_the_step_response_says():
    rig = Rig(paper_block(), Faults(Servo(time_constant=0.1)))
    for _ in range(5):
        rig.step(0.01, 0.02)
    assert rig.finger_x == pytest.approx(0.01 * (0.1 - 0.1 * (1.0 - 1.0 / math.e)), abs=1e-9)
    assert rig.v_x == pytest.approx(0.01 * (1.0 - 1.0 / math.e))
    assert rig.finger_y == pytest.approx(V_Y * 0.1)


def test_delayed_finger_pushes_straight_ahead_first():
    late, ahead, now = (
        Rig(paper_block(), Faults(Servo(delay=0.25))),
        Rig(paper_block()),
        Rig(paper_block()),
    )
    for _ in range(5):
        late.step(0.003, 0.1)
    ahead.step(0.0, 0.25)
    ahead.step(0.003, 0.25)
    now.step(0.003, 0.5)
    assert late.theta == pytest.approx(ahead.theta, abs=1e-6)
    assert abs(late.theta - now.theta) > 1e-3


def test_quantised_finger_moves_in_whole_quanta():
    rig = Rig(paper_block(), Faults(Servo(velocity_quantum=0.001)))
    rig.step(0.0016, 0.1)
    assert rig.v_x == pytest.approx(0.002)
    assert rig.finger_x == pytest.approx(0.0002)
    rig.step(0.0004, 0.1)
    assert rig.v_x == 0.0


@pytest.mark.parametrize('side', [1.0, -1.0])
@pytest.mark.parametrize('time_constant', [0.0, 0.1])
def test_finger_stops_at_its_workspace_and_comes_back(side, time_constant):
    workspace = Workspace(HOME - 0.004, HOME + 0.004)
    rig = Rig(paper_block(), Faults(Servo(time_constant), workspace))
    for _ in range(20):
        rig.step(0.01 * side, 0.1)
        assert abs(rig.finger_x) <= 0.004 + 1e-15
    assert rig.at_workspace_limit
    assert rig.finger_x == pytest.approx(0.004 * side, abs=1e-12)
    assert rig.v_x == 0.0
    assert rig.finger_y == pytest.approx(2.0 * V_Y)  # the belt goes on
    rig.step(-0.01 * side, 0.1)
    assert not rig.at_workspace_limit
    assert abs(rig.finger_x) < 0.004


def test_finger_reaches_the_bound_within_a_step():
    rig = Rig(paper_block(), Faults(workspace=Workspace(upper=HOME + 0.004)))
    rig.step(0.01, 1.0)
    assert rig.finger_x == pytest.approx(0.004)
    whole = Rig(paper_block())
    whole.step(0.01, 0.4)
    whole.step(0.0, 0.6)
    assert rig.theta == pytest.approx(whole.theta, abs=1e-9)


def test_reach_of_the_links_stays_a_limit():
    rig = Rig(paper_block(), Faults(Servo(time_constant=0.05)))
    for _ in range(200):
        rig.step(0.05, 0.1, belt_running=False)
    assert rig.at_workspace_limit
    assert rig.v_x == 0.0
    assert rig.finger_x <= 0.06 + math.sqrt(0.14**2 - 0.08**2)


def test_uneven_belt_travels_as_the_integral_of_its_speed():
    rig = Rig(paper_block(), Faults(belt=Belt(0.5, 0.5)))
    rig.step(0.001, 1.0)  # half a ripple, all of it on the fast side
    assert rig.finger_y == pytest.approx(V_Y * (1.0 + 0.5 * 2.0 / math.pi))
    rig.step(0.001, 1.0)
    assert rig.finger_y == pytest.approx(2.0 * V_Y)


def test_stopped_belt_leaves_the_finger_alone_to_move():
    rig, still = Rig(paper_block(), Faults(belt=Belt(stopped=True))), Rig(paper_block())
    rig.step(0.003, 0.3)
    still.step(0.003, 0.3, belt_running=False)
    assert state(rig) == state(still)


def test_object_of_uneven_friction_sticks_where_it_is_rough_and_slips_where_it_is_smooth():
    # The edge begins at sigma = 0, its middle is at 25 mm: 6.25 waves. Half a wave to the right
    # the friction is least.
    edge = math.radians(40.0)
    faults = Faults(friction=UnevenFriction(0.5, 0.004))
    rough, smooth = (Rig(paper_block(edge, d, mu_c=0.4), faults) for d in (0.0, 0.002))
    for rig in (rough, smooth):
        rig.step(0.0, 1e-4)
    assert rough.mode == STICK
    assert smooth.mode == SLIP_RIGHT  # up along the edge
    for rig, mu_c in ((rough, 0.6), (smooth, 0.2)):
        left, normal = (rig.contact_directions[name] for name in ('left', 'normal'))
        cos = left[0] * normal[0] + left[1] * normal[1]
        assert math.sqrt(1.0 / cos**2 - 1.0) == pytest.approx(mu_c, rel=1e-3)


def test_faults_may_change_while_the_rig_moves():
    rig, paper = Rig(paper_block()), Rig(paper_block())
    rig.step(0.002, 0.1)
    rig.faults = Faults(Servo(time_constant=0.2))
    rig.step(0.004, 0.1)
    lag = 0.2 * (1.0 - math.exp(-0.5))
    assert rig.finger_x == pytest.approx(0.0002 + 0.004 * 0.1 - 0.002 * lag)
    rig.faults = Faults()
    rig.step(0.0, 0.1)
    assert rig.v_x == 0.0
    for v_x in (0.002, 0.004, 0.0):
        paper.step(v_x, 0.1)
    assert abs(rig.theta - paper.theta) > 1e-5
