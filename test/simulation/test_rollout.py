# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support.expected import FIGURE_8_SETTLE_STEP, assert_is_end_of_figure_8, each_step_of_figure_8
from support.strategies import corners_on_ellipses
from support.turning_tip import step_response
from tactile_push.control import AHEAD, PushLaw, settle_step
from tactile_push.mechanics import FREE, MODES, SLIP_LEFT, SLIP_RIGHT, STICK, Outline, Slider
from tactile_push.simulation import (
    Faults,
    Rig,
    RigConfig,
    Servo,
    experiment,
    paper_block,
    paper_disk,
    rollout,
    rollouts,
)
from tactile_push.tactile import PlanarFinger

checked = settings(derandomize=True, deadline=None, max_examples=100)
THETA_D = math.radians(-10.0)
LOWER, UPPER = math.radians(33.0), math.radians(147.0)
V_Y = 0.005
R = 0.0135
DISK_RADIUS = 0.0285
QUANTITIES = ('theta', 'phi', 'd', 'x', 'y', 'mode')


def papers_law(theta_desired=THETA_D, phi=AHEAD):
    law = PushLaw(0.05, 5.0, theta_desired)
    law.reset(phi)
    return law


def assert_same(one, other, length=None):
    """Check that two rollouts, or the first part of the second, are the same to the bit."""
    for name in QUANTITIES:
        assert np.array_equal(getattr(one, name), getattr(other, name)[:length]), name


@pytest.fixture(scope='module')
def fig_8():
    """Return the step response of fig. 8 with kp = 0.05 and kd = 5."""
    return rollout(paper_block(), papers_law(), 600)


@each_step_of_figure_8
def test_step_response_of_figure_8(fig_8, k, theta, phi):
    assert math.degrees(fig_8.theta[k]) == pytest.approx(theta, abs=0.006)
    assert math.degrees(fig_8.phi[k]) == pytest.approx(phi, abs=0.06)


def test_step_response_of_figure_8_settles_and_translates(fig_8):
    assert settle_step(fig_8.theta, THETA_D, math.radians(3.0)) == FIGURE_8_SETTLE_STEP
    assert_is_end_of_figure_8(fig_8.theta[-1], fig_8.phi[-1], fig_8.d[-1])
    assert fig_8.end == 'done'


def test_contact_that_sticks_rolls_as_far_as_the_edge_turns(fig_8):
    # (16) with no slip: d' = -r theta'.
    assert np.all(fig_8.mode == STICK)
    assert fig_8.d - fig_8.d[0] == pytest.approx(-R * (fig_8.theta - fig_8.theta[0]), abs=1e-12)


def test_rows_are_one_more_than_the_steps_and_start_as_configured(fig_8):
    for name in QUANTITIES:
        assert getattr(fig_8, name).shape == (601,)
        assert np.all(np.isfinite(getattr(fig_8, name)))
    assert math.degrees(fig_8.theta[0]) == pytest.approx(20.0)
    assert math.degrees(fig_8.phi[0]) == pytest.approx(90.0)
    assert fig_8.d[0] == pytest.approx(-0.006, abs=1e-15)
    # The finger at the origin: CM at (r + l) n - d t.
    sin, cos = math.sin(math.radians(20.0)), math.cos(math.radians(20.0))
    assert fig_8.x[0] == pytest.approx(-0.03725 * sin + 0.006 * cos)
    assert fig_8.y[0] == pytest.approx(0.03725 * cos + 0.006 * sin)
    assert fig_8.mode.dtype == np.int64


def test_centre_of_mass_lies_where_finger_theta_and_d_put_it(fig_8):
    # The finger goes v_y / tan(phi) across the belt; from it the CM is at (r + l) n - d t.
    x_f = np.concatenate([[0.0], np.cumsum(0.0005 / np.tan(fig_8.phi[:-1]))])
    y_f = 0.0005 * np.arange(601)
    sin, cos = np.sin(fig_8.theta), np.cos(fig_8.theta)
    assert fig_8.x == pytest.approx(x_f - 0.03725 * sin - fig_8.d * cos, abs=1e-12)
    assert fig_8.y == pytest.approx(y_f + 0.03725 * cos - fig_8.d * sin, abs=1e-12)


def test_law_18_links_the_columns(fig_8):
    theta, phi = fig_8.theta, fig_8.phi
    by_law = phi[:-1] + 0.05 * (theta[1:] - THETA_D) + 5.0 * np.diff(theta)
    inside = (by_law > LOWER) & (by_law < UPPER)
    assert inside.sum() > 500
    assert phi[1:][inside] == pytest.approx(by_law[inside], abs=1e-12)


@pytest.mark.parametrize(('theta_desired', 'bound'), [(-0.5, 110.0), (0.8, 60.0)])
def test_push_angle_stays_within_the_bounds_of_the_law(theta_desired, bound):
    # Much too high a gain.
    law = PushLaw(5.0, 0.0, theta_desired, math.radians(60.0), math.radians(110.0))
    result = rollout(paper_block(), law, 10)
    assert result.end == 'done'
    assert np.all(result.phi[1:] == math.radians(bound))


def test_first_push_is_the_one_of_the_first_period(fig_8):
    # phi(0) = 90 degrees drives period 0, in which the finger pushes 0.5 mm in +y. The CM moves
    # by about that minus the part that turns the block.
    assert 0.0 < fig_8.y[1] - fig_8.y[0] < 0.0005
    one = rollout(paper_block(), papers_law(), 1)
    assert_same(one, fig_8, 2)
    assert one.mode[0] == one.mode[1]


def test_shorter_rollout_is_the_start_of_a_longer_one(fig_8):
    assert_same(rollout(paper_block(), papers_law(), 77), fig_8, 78)


def test_law_is_the_same_afterwards_and_starts_from_its_push_angle():
    law = papers_law(phi=1.3)
    first = rollout(paper_block(), law, 20)
    assert law.phi == 1.3
    assert first.phi[0] == 1.3
    assert_same(rollout(paper_block(), law, 20), first)


def test_period_is_the_length_of_a_push():
    short = rollout(paper_block(), AHEAD, 20, period=0.05)
    long = rollout(paper_block(), AHEAD, 10, period=0.1)
    for name in ('theta', 'd', 'x', 'y'):
        assert getattr(short, name)[::2] == pytest.approx(getattr(long, name), abs=1e-7)
    assert short.theta[1] != pytest.approx(long.theta[1], abs=1e-6)


def test_given_push_angles_replay_what_the_law_did(fig_8):
    again = rollout(paper_block(), fig_8.phi[:-1], 600)
    for name in ('theta', 'd', 'x', 'y', 'mode'):
        assert np.array_equal(getattr(again, name), getattr(fig_8, name))
    assert np.array_equal(again.phi[:-1], fig_8.phi[:-1])
    assert again.end == 'done'


@checked
@given(
    phi=st.floats(LOWER, UPPER),
    theta=st.floats(-0.4, 0.4),
    d=st.floats(-0.02, 0.02),
    mu_c=st.sampled_from([0.0, 0.25, math.inf]),
)
def test_constant_push_angle_is_the_law_without_gains(phi, theta, d, mu_c):
    config = paper_block(theta, d, mu_c=mu_c)
    law = PushLaw(0.0, 0.0, 0.3)
    law.reset(phi)
    by_law = rollout(config, law, 40)
    given_once = rollout(config, phi, 40)
    given_often = rollout(config, [phi] * 40, 40)
    assert np.all(by_law.phi == phi)
    assert_same(given_once, by_law)
    assert_same(given_often, by_law)
    assert given_once.end == by_law.end


def test_given_push_angles_drive_one_period_each():
    pushes = np.array([1.2, 1.9, AHEAD, 1.0])
    result = rollout(paper_block(), pushes, 4)
    assert np.array_equal(result.phi[:4], pushes)
    config = paper_block()
    rig = Rig(config)
    for k, phi in enumerate(pushes):
        rig.step(V_Y / math.tan(phi), 0.1)
        assert result.theta[k + 1] == pytest.approx(rig.theta, abs=1e-12)
        assert result.mode[k] == rig.mode


@pytest.mark.parametrize('mu_c', [0.0, math.inf])
@pytest.mark.parametrize('theta_0', [20.0, -35.0])
def test_disk_follows_the_law_on_a_closed_form(mu_c, theta_0):
    # With beta = theta + 90 degrees - phi, and v the finger's speed, without friction the disk
    # only translates, so beta' = v sin(beta) / (R + r); when it sticks and rolls,
    # beta' = v sin(beta) R^2 / ((R + r) (c^2 + R^2)). So tan(beta / 2) grows exponentially.
    rate = 1.0 / (DISK_RADIUS + R)
    if mu_c:
        rate *= DISK_RADIUS**2 / (0.019**2 + DISK_RADIUS**2)
    theta, phi = [math.radians(theta_0)], [AHEAD]
    for _ in range(400):
        beta = theta[-1] + AHEAD - phi[-1]
        way = 0.0005 / math.sin(phi[-1])
        beta = 2.0 * math.atan(math.tan(beta / 2.0) * math.exp(way * rate))
        theta.append(beta - AHEAD + phi[-1])
        push = phi[-1] + 0.05 * (theta[-1] - 0.1) + 5.0 * (theta[-1] - theta[-2])
        phi.append(min(max(push, LOWER), UPPER))
    result = rollout(paper_disk(math.radians(theta_0), mu_c), papers_law(0.1), 400)
    assert result.end == 'done'
    assert result.theta == pytest.approx(np.array(theta), abs=1e-7)
    assert result.phi == pytest.approx(np.array(phi), abs=1e-6)
    assert np.all(np.abs(result.d) < 1e-15)
    assert set(result.mode.tolist()) <= ({STICK} if mu_c else {SLIP_LEFT, SLIP_RIGHT})


def test_frictionless_disk_never_turns_in_a_whole_rollout():
    config = paper_disk(mu_c=0.0)
    result = rollout(config, papers_law(0.0), 500)
    rig = Rig(config)
    for k in range(500):
        rig.step(V_Y / math.tan(result.phi[k]), 0.1)
        assert rig.object_pose.angle == pytest.approx(math.radians(20.0), abs=1e-12)
    assert rig.theta == pytest.approx(result.theta[-1], abs=1e-9)
    assert abs(rig.theta - math.radians(20.0)) > 0.05


def test_disk_settles_at_zero():
    result = rollout(paper_disk(), papers_law(0.0), 600)
    assert result.end == 'done'
    assert settle_step(result.theta, 0.0, math.radians(1.0)) < 500
    assert np.all(np.abs(result.d) < 1e-15)


def vote(theta, d, phi, mu_c, l=0.02375):
    """Return Mason's vote: 1 counterclockwise, -1 clockwise, 0 if a ray is near the CM."""
    alpha = math.pi / 2.0 if math.isinf(mu_c) else math.atan(mu_c)
    # In the edge's frame the CM is at (-d, l) from the contact; a ray passes to its right if a
    # force along it has a positive moment.
    rays = (math.pi / 2.0 - alpha, math.pi / 2.0 + alpha, phi - theta)
    moments = [d * math.sin(ray) + l * math.cos(ray) for ray in rays]
    if min(abs(moment) for moment in moments) < 1e-6:
        return 0
    return 1 if sum(moment > 0.0 for moment in moments) >= 2 else -1


@pytest.mark.parametrize('c', [0.0345, 0.0187, 0.0067])
@pytest.mark.parametrize('mu_c', [0.0, 0.3, 1.0, math.inf])
def test_open_loop_pushes_of_figure_7_turn_as_the_voting_theorem_says(c, mu_c):
    result = rollout(paper_block(0.0, -0.005, c, mu_c), AHEAD, 150)
    assert np.all(result.phi == AHEAD)
    assert len(result.theta) > 40
    votes = 0
    for theta, d, after in zip(result.theta, result.d, result.theta[1:], strict=False):
        if abs(d) < 0.025:  # on the edge, where theta is the object's angle
            sense = vote(theta, d, AHEAD, mu_c)
            votes += sense
            if sense:
                assert math.copysign(1.0, after - theta) == sense
    assert votes < -20  # d(0) < 0: clockwise


def test_smaller_c_turns_faster():
    ends = [rollout(paper_block(0.0, -0.005, c), AHEAD, 50).theta[-1] for c in (0.0345, 0.0187)]
    assert ends[1] < ends[0] < -0.01


@st.composite
def pushed_polygons(draw):
    """Draw corners of a polygon about the origin and a contact on its first edge."""
    corners = draw(corners_on_ellipses(most_corners=6, least_axis=0.01))
    along = (corners[1] - corners[0]) / math.hypot(*(corners[1] - corners[0]))
    first, last = along @ corners[0], along @ corners[1]
    return corners, first + draw(st.floats(0.05, 0.95)) * (last - first)


RUNS = {
    'shape': pushed_polygons(),
    'theta': st.floats(-0.5, 0.5),
    'phi': st.floats(LOWER, UPPER),
    'theta_desired': st.floats(-0.3, 0.3),
    'c': st.floats(0.005, 0.03),
    'mu_c': st.sampled_from([0.0, 0.1, 0.5, math.inf]),
}


@pytest.mark.slow
@checked
@given(**RUNS)
def test_mirror_images_have_mirrored_rollouts(shape, theta, phi, theta_desired, c, mu_c):
    corners, d = shape
    # Mirrored, the corners come clockwise; the first edge stays the first.
    mirrored = np.roll((corners * (-1.0, 1.0))[::-1], 2, axis=0)
    config = RigConfig(Slider(Outline.polygon(corners), c), mu_c, theta, d, tip_turns=False)
    slider = Slider(Outline.polygon(mirrored), c)
    mirror = RigConfig(slider, mu_c, -theta, -d, tip_turns=False)
    one = rollout(config, papers_law(theta_desired, phi), 60)
    other = rollout(mirror, papers_law(-theta_desired, math.pi - phi), 60)
    assert len(other.theta) == len(one.theta)
    assert other.theta == pytest.approx(-one.theta, abs=1e-6)
    assert other.phi - AHEAD == pytest.approx(AHEAD - one.phi, abs=1e-5)
    assert other.d == pytest.approx(-one.d, abs=1e-7)
    assert other.x == pytest.approx(-one.x, abs=1e-7)
    assert other.y == pytest.approx(one.y, abs=1e-7)
    image = {FREE: FREE, STICK: STICK, SLIP_LEFT: SLIP_RIGHT, SLIP_RIGHT: SLIP_LEFT}
    assert np.mean(other.mode == [image[mode] for mode in one.mode.tolist()]) > 0.95


@pytest.mark.slow
@checked
@given(**RUNS, scale=st.one_of(st.sampled_from([1.0 / 64.0, 4.0]), st.floats(0.1, 10.0)))
def test_scaled_lengths_scale_the_rollout(shape, theta, phi, theta_desired, c, mu_c, scale):
    corners, d = shape
    config = RigConfig(Slider(Outline.polygon(corners), c), mu_c, theta, d, tip_turns=False)
    scaled = RigConfig(
        Slider(Outline.polygon(scale * corners), scale * c),
        mu_c,
        theta,
        scale * d,
        belt_speed=scale * V_Y,
        radius=scale * R,
        tip_turns=False,
    )
    one = rollout(config, papers_law(theta_desired, phi), 60)
    other = rollout(scaled, papers_law(theta_desired, phi), 60)
    assert len(other.theta) == len(one.theta)
    assert other.theta == pytest.approx(one.theta, abs=1e-6)
    assert other.phi == pytest.approx(one.phi, abs=1e-5)
    for name in ('d', 'x', 'y'):
        assert getattr(other, name) / scale == pytest.approx(getattr(one, name), abs=1e-7)


@pytest.mark.slow
@checked
@given(**RUNS)
def test_rollout_is_what_the_rig_does_until_contact_is_lost(
    shape, theta, phi, theta_desired, c, mu_c
):
    corners, d = shape
    far = PlanarFinger(1.0, 1.0, 0.0)
    slider = Slider(Outline.polygon(corners), c)
    config = RigConfig(slider, mu_c, theta, d, finger=far, tip_turns=False)
    result = rollout(config, papers_law(theta_desired, phi), 100)
    rig = Rig(config)
    steps = len(result.theta) - 1
    for k in range(steps + 1):
        assert rig.touching
        reached = (rig.theta, rig.d, rig.object_pose.x, rig.object_pose.y)
        assert reached == pytest.approx(
            (result.theta[k], result.d[k], result.x[k], result.y[k]), abs=1e-9
        )
        if k < 100:
            rig.step(V_Y / math.tan(result.phi[k]), 0.1)
            assert not rig.at_workspace_limit
            assert rig.mode == result.mode[k]
    if steps < 100:
        assert not rig.touching
        assert result.mode[-1] == FREE
        assert result.end == f'the finger lost the object in step {steps}'
    else:
        assert result.end == 'done'


@pytest.mark.parametrize(
    ('corners', 'theta', 'mu_c', 'phi'),
    [
        ([(-0.002, -0.002), (0.002, -0.002), (0.0, 0.003)], -0.5, 0.0, 90.0),
        ([(-0.002, -0.002), (0.002, -0.002), (0.002, 0.002), (-0.002, 0.002)], 0.6, 0.1, 90.0),
        ([(-0.002, -0.02), (0.002, -0.02), (0.002, 0.02), (-0.002, 0.02)], 0.0, 0.2, 140.0),
        ([(-0.0005, -0.01), (0.0005, -0.01), (0.01, 0.01), (-0.01, 0.01)], 0.0, 0.3, 35.0),
    ],
)
def test_lost_contact_ends_the_rollout_with_the_reason(corners, theta, mu_c, phi):
    config = RigConfig(Slider(Outline.polygon(corners), 0.002), mu_c, theta, 0.0)
    result = rollout(config, math.radians(phi), 2000)
    last = len(result.theta) - 1
    assert 2 < last < 2000
    assert result.end == f'the finger lost the object in step {last}'
    for name in QUANTITIES:
        assert getattr(result, name).shape == (last + 1,)
        assert np.all(np.isfinite(getattr(result, name)))
    assert MODES[result.mode[-1]] == 'free'  # in the last period the contact was lost
    assert np.all(result.mode[:-1] != FREE)
    # Around a corner: theta went on while the contact stayed there.
    assert np.ptp(result.theta) > 0.1
    # It takes one step more than it had contact to find out.
    assert rollout(config, math.radians(phi), last).end == 'done'
    assert_same(result, rollout(config, math.radians(phi), last + 1))


def test_object_that_is_lost_in_the_first_period_leaves_the_start_alone():
    corners = [(-0.002, -0.002), (0.002, -0.002), (0.0, 0.003)]
    config = RigConfig(Slider(Outline.polygon(corners), 0.002), 0.0, -0.5, 0.0, tip_turns=False)
    result = rollout(config, papers_law(), 10, period=20.0)
    assert len(result.theta) == 1
    assert result.mode.tolist() == [FREE]
    assert result.end == 'the finger lost the object in step 0'


@pytest.mark.parametrize('law', [papers_law(), AHEAD, []])
def test_no_steps_give_the_start_alone(law):
    result = rollout(paper_block(), law, 0)
    assert result.theta == pytest.approx([math.radians(20.0)])
    assert result.phi == pytest.approx([AHEAD])
    assert result.mode.tolist() == [FREE]
    assert result.end == 'done'


@pytest.mark.parametrize(
    ('name', 'arguments', 'value'),
    [
        ('steps', (papers_law(), -1), '-1'),
        ('period', (papers_law(), 1, 0.0), '0.0'),
        ('period', (papers_law(), 1, -0.1), '-0.1'),
        ('period', (papers_law(), 1, math.nan), 'nan'),
        ('period', (papers_law(), 1, math.inf), 'inf'),
        ('law', (0.0, 3), '0.0'),
        ('law', (math.pi, 3), '3.14'),
        ('law', (-1.0, 3), '-1.0'),
        ('law', ([1.0, 1.0, math.nan], 3), 'nan'),
        ('law', ([1.0, 4.0, 1.0], 3), '4.0'),
        ('phi', (0.3, 3), '0.3'),
        ('phi', (papers_law(phi=LOWER), 3), '0.57'),
        ('law', ([1.0, 1.0], 3), '2'),
        ('law', ([[1.0], [1.0]], 2), '2, 1'),
    ],
)
def test_argument_out_of_its_range_is_refused_by_name_and_value(name, arguments, value):
    with pytest.raises(ValueError, match=f'^{name}: expected .*{value}'):
        # phi from 40 degrees on goes towards the edge.
        rollout(paper_block(math.radians(40.0)), *arguments)


@pytest.mark.parametrize('mu_c', [0.0, 0.3, math.inf])
@pytest.mark.parametrize(
    'servo',
    [
        Servo(time_constant=0.1),
        Servo(delay=0.3),
        Servo(delay=0.04),
        Servo(0.1, 0.1),
        Servo(0.05, 0.23, 1e-4),
    ],
    ids=str,
)
def test_servo_of_the_rollout_is_that_of_the_rig(servo, mu_c):
    config = paper_block(mu_c=mu_c)
    here = rollout(config, papers_law(), 300, servo=servo)
    there = experiment(config, papers_law(), 300, faults=Faults(servo))
    assert (here.end, there.end) == ('done', 'done')
    for name in ('theta', 'phi', 'd', 'x', 'y'):
        assert getattr(here, name) == pytest.approx(getattr(there, name), abs=1e-6), name


def test_perfect_servo_changes_nothing():
    without, perfect = (rollout(paper_block(), papers_law(), 200, servo=s) for s in (None, Servo()))
    for name in QUANTITIES:
        assert getattr(perfect, name) == pytest.approx(getattr(without, name), abs=1e-12), name


@pytest.mark.parametrize('periods', [1, 3, 7])
def test_delay_of_whole_periods_drives_each_push_by_an_older_command(periods):
    late = rollout(paper_block(), papers_law(), 100, servo=Servo(delay=periods * 0.1))
    pushes = np.concatenate([np.full(periods, AHEAD), late.phi[: 100 - periods]])
    replayed = rollout(paper_block(), pushes, 100)
    assert replayed.theta == pytest.approx(late.theta, abs=1e-9)
    assert replayed.x == pytest.approx(late.x, abs=1e-9)


def test_object_that_a_lagging_finger_loses_ends_the_rollout():
    slider = Slider(Outline.rectangle(0.004, 0.0475), 0.0187)
    config = RigConfig(slider, 0.0, math.radians(-30.0), 0.0)
    lost = rollout(config, AHEAD, 200, servo=Servo(time_constant=0.1))
    assert lost.end.startswith('the finger lost the object')
    assert len(lost.theta) == len(rollout(config, AHEAD, 200).theta)


@pytest.mark.parametrize(('point', 'error'), [('centre', 1e-6), ('pole', 1e-6), ('contact', 5e-4)])
def test_tip_that_turns_gives_the_step_response_of_plane_geometry(point, error):
    # While the contact is commanded, theta counts as constant over half a millimetre.
    config = replace(paper_block(), tip_turns=True, commanded_point=point)
    found = rollout(config, papers_law(), 450)
    theta, phi, d = np.array(step_response(450, point)).T
    assert np.degrees(found.theta) == pytest.approx(theta, abs=error)
    assert np.degrees(found.phi) == pytest.approx(phi, abs=10.0 * error)
    assert found.d == pytest.approx(d, abs=1e-3 * error)
    assert np.all(found.mode == STICK)


@pytest.mark.parametrize('point', ['centre', 'pole', 'contact'])
def test_rig_and_experiment_do_what_the_rollout_of_a_turning_tip_does(point):
    config = replace(paper_block(mu_c=0.2), tip_turns=True, commanded_point=point)
    found, expected = experiment(config, papers_law(), 200), rollout(config, papers_law(), 200)
    assert (found.end, expected.end) == ('done', 'done')
    for name in ('theta', 'phi', 'd', 'x', 'y'):
        assert getattr(found, name) == pytest.approx(getattr(expected, name), abs=1e-7), name


def test_batch_takes_the_tip_of_a_rig():
    config = replace(paper_block(), tip_turns=True)
    one = rollout(config, papers_law(), 100)
    law = {'kp': 0.05, 'kd': 5.0, 'theta_desired': THETA_D}
    many = rollouts(config.slider, theta=config.theta, d=config.d, steps=100, tip=config.tip, **law)
    assert many.theta[0] == one.theta[-1]
    assert many.d[0] == one.d[-1]
    without = rollouts(config.slider, theta=config.theta, d=config.d, steps=100, **law)
    assert abs(without.d[0] - many.d[0]) > 1e-4
