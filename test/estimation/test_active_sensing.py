# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From ticks to pushes: what is fed when, and when all is forgotten."""

import math
from dataclasses import dataclass, field

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.estimation import (
    ActiveSensing,
    DiskEstimator,
    FingerMotion,
    ObjectEstimator,
    edges_of,
    sensing_values,
)
from tactile_push.estimation.active_sensing import (
    CONTACT_LOST,
    JOINTS_DOUBTED,
    MOTION_UNKNOWN,
    TICKS_MISSING,
    TIME_WENT_BACK,
    TIP_UNKNOWN,
)
from tactile_push.estimation.contradictions import BLIND, CONTRADICTIONS, DISOBEYED
from tactile_push.interface import SILENT, STRAIGHT, WIDEN
from tactile_push.mechanics import CENTRE, CONTACT, POLE

BELT = 0.005
PERIOD = 0.1


@dataclass
class Listener:
    """An estimator that only listens."""

    pushes: list[tuple[float, float, float, float]] = field(default_factory=list)
    spins: list[float] = field(default_factory=list)
    touches: list[tuple[float, float, float]] = field(default_factory=list)
    resets: int = 0

    def push(self, theta, v_x, v_y, duration, spin):
        self.pushes.append((theta, v_x, v_y, duration))
        self.spins.append(spin)

    def touch_again(self, theta, way, unfelt):
        self.touches.append((theta, way, unfelt))

    def estimate(self):
        return None

    def reset(self):
        self.resets += 1
        self.pushes.clear()
        self.spins.clear()


@pytest.fixture
def listener() -> Listener:
    return Listener()


@pytest.fixture
def sensing(listener) -> ActiveSensing:
    return ActiveSensing(listener, FingerMotion(), BELT, 0.3)


def test_push_is_the_motion_between_two_readings(sensing, listener):
    # Readings 20 ms and 70 ms old: the finger went on with the first command for 30 of 50 ms.
    sensing.tick(1.0, 0.30, 0.02, 0.001)
    sensing.tick(1.1, 0.31, 0.07, 0.004)
    sensing.tick(1.2, 0.32, 0.00, 0.002)
    assert listener.pushes == [
        pytest.approx((0.30, 0.0, BELT, 0.0)),
        pytest.approx((0.31, 0.001 * 0.03 / 0.05, BELT, 0.05)),
        pytest.approx((0.32, (0.001 * 0.07 + 0.004 * 0.10) / 0.17, BELT, 0.17)),
    ]
    assert sensing.readings == 3


def test_push_ends_when_the_reading_is_stamped_even_if_that_is_ahead(sensing, listener):
    # From 20 ms after each tick to 20 ms after the next one: 80 ms of one command, 20 of the next.
    sensing.tick(1.0, 0.30, -0.02, 0.001)
    sensing.tick(1.1, 0.31, -0.02, 0.004)
    sensing.tick(1.2, 0.32, -0.02, 0.002)
    assert listener.pushes == [
        pytest.approx((0.30, 0.0, BELT, 0.0)),
        pytest.approx((0.31, 0.8 * 0.001 + 0.2 * 0.004, BELT, 0.1)),
        pytest.approx((0.32, 0.8 * 0.004 + 0.2 * 0.002, BELT, 0.1)),
    ]
    assert sensing.readings == 3
    assert sensing.age == -0.02


@pytest.mark.parametrize('ahead', [1e-9, 0.02, 0.2999])
def test_reading_that_is_ahead_is_a_reading(sensing, ahead):
    for k in range(20):
        sensing.tick(1.0 + 0.1 * k, 0.3, -ahead, 0.001)
        assert (sensing.forgot, sensing.readings, sensing.took) == ('', k + 1, True)


def test_commands_between_tick_and_stamp_are_made_up_for_in_the_next_push(sensing, listener):
    # Stamped 150 ms ahead, in every other tick. Commands change at 1.0, 1.1, ..., 1.5.
    sensing.tick(1.0, 0.30, -0.15, 0.001)
    sensing.tick(1.1, 0.30, -0.05, 0.004)
    sensing.tick(1.2, 0.31, -0.15, 0.002)  # 1.15 to 1.35
    sensing.tick(1.3, 0.31, -0.05, 0.003)  # the finger has 50 ms more of 3 than of 2 mm/s
    sensing.tick(1.4, 0.32, -0.15, 0.005)  # 1.35 to 1.55
    sensing.tick(1.5, 0.32, -0.05, 0.000)
    told = 0.05 * 0.004 + 0.15 * 0.002, 0.05 * 0.001 + 0.05 * 0.003 + 0.15 * 0.005
    assert listener.pushes == [
        pytest.approx((0.30, 0.0, BELT, 0.0)),
        *(
            pytest.approx((theta, way / 0.2, BELT, 0.2))
            for theta, way in zip((0.31, 0.32), told, strict=True)
        ),
    ]


def test_clock_that_is_ahead_does_not_make_a_reading_last_longer(sensing, listener):
    for stamp in (1.0, 1.125, 1.25):
        sensing.tick(stamp, 0.3, stamp - 1.25, 0.001)
        assert (sensing.readings, sensing.forgot) == (1, '')
    sensing.tick(1.375, 0.3, 0.125, 0.001)
    assert (sensing.readings, sensing.forgot) == (0, 'contact lost')
    sensing.tick(1.5, 0.3, 0.25, 0.001)  # the same reading again
    assert sensing.readings == 0
    sensing.tick(1.625, 0.31, -0.25, 0.001)
    assert (sensing.readings, sensing.forgot) == (1, '')


def test_reading_that_comes_again_is_no_reading(sensing, listener):
    sensing.tick(1.0, 0.30, 0.0, 0.001)
    sensing.tick(1.1, 0.30, 0.1, 0.002)
    sensing.tick(1.2, 0.30, 0.2, 0.003)
    assert sensing.readings == 1
    sensing.tick(1.3, 0.31, 0.0, 0.004)
    assert listener.pushes[1] == pytest.approx((0.31, 0.002, BELT, 0.3))


def test_it_tells_which_tick_brought_a_reading(sensing):
    told = []
    for tick in ((1.0, 0.3, 0.0), (1.1, 0.3, 0.1), (1.2, 0.31, 0.0), (1.3, math.nan, 0.1)):
        sensing.tick(*tick, 0.001)
        told.append(sensing.took)
    assert told == [True, False, True, False]


def test_older_reading_is_no_reading(sensing, listener):
    sensing.tick(1.0, 0.30, 0.0, 0.001)
    sensing.tick(1.1, 0.29, 0.2, 0.001)
    assert sensing.readings == len(listener.pushes) == 1


@pytest.mark.parametrize(
    ('tick', 'reason'),
    [
        ((1.2, math.nan, 0.0, 0.0), 'contact lost'),
        ((1.2, 0.3, 0.35, 0.0), 'contact lost'),
        ((1.2, 0.3, -0.35, 0.0), 'contact lost'),
        ((1.2, 0.3, -math.inf, 0.0), 'contact lost'),
        ((1.2, 0.3, math.nan, 0.0), 'contact lost'),
        ((1.45, 0.3, 0.0, 0.0), 'ticks missing'),
        ((1.05, 0.3, 0.0, 0.0), 'time went back'),
    ],
)
def test_what_is_no_push_any_more_is_forgotten(sensing, listener, tick, reason):
    sensing.tick(1.0, 0.30, 0.0, 0.001)
    sensing.tick(1.1, 0.31, 0.0, 0.001)
    assert not sensing.forgot
    sensing.tick(*tick)
    assert sensing.forgot == reason
    assert listener.resets == 1


def test_finger_that_somebody_else_moved_is_forgotten(sensing, listener):
    sensing.tick(1.0, 0.30, 0.0, 0.001)
    sensing.tick(1.1, 0.31, 0.0, math.nan)
    sensing.tick(1.2, 0.32, 0.0, 0.001)
    assert sensing.forgot == 'the finger moved unknown to the controller'
    assert sensing.readings == 1
    assert listener.pushes[-1][3] == 0.0  # a beginning


@pytest.mark.parametrize('v_x', [math.inf, -math.inf, 1e308])
def test_velocity_that_no_finger_has_is_none(sensing, listener, v_x):
    sensing.tick(1.0, 0.30, 0.0, 0.001)
    sensing.tick(1.1, 0.31, 0.0, v_x)
    sensing.tick(1.2, 0.32, 0.0, 0.001)
    assert sensing.forgot == 'the finger moved unknown to the controller'
    assert all(abs(push[1]) < 0.1 for push in listener.pushes)


@pytest.mark.parametrize('theta', [math.inf, 1e308, 1.6, -1.6])
def test_angle_that_no_pushed_edge_has_is_no_reading(sensing, listener, theta):
    sensing.tick(1.0, theta, 0.0, 0.001)
    assert not listener.pushes
    sensing.tick(1.1, 0.3, 0.0, 0.001)
    sensing.tick(1.2, theta, 0.0, 0.001)
    assert sensing.forgot == 'contact lost'


def test_nothing_begins_while_the_finger_is_not_commanded(sensing, listener):
    sensing.tick(1.0, 0.30, 0.0, math.nan)
    assert sensing.readings == 0
    assert not listener.pushes
    assert not sensing.forgot


def test_it_begins_again_with_the_velocity_that_the_finger_has(sensing, listener):
    sensing.tick(1.0, 0.30, 0.0, 0.001)
    sensing.tick(1.1, math.nan, 0.0, 0.004)
    sensing.tick(1.2, 0.31, 0.05, 0.002)
    sensing.tick(1.3, 0.32, 0.0, 0.002)
    assert listener.pushes[-1] == pytest.approx(
        (0.32, (0.004 * 0.05 + 0.002 * 0.1) / 0.15, BELT, 0.15)
    )


def test_finger_that_lags_is_followed(listener):
    sensing = ActiveSensing(listener, FingerMotion(lag=0.1), BELT, 0.3)
    sensing.tick(1.0, 0.30, 0.0, 0.01)
    sensing.tick(1.1, 0.31, 0.0, 0.01)
    # A lag of 0.1 s goes 0.01 (0.1 - 0.1 (1 - 1/e)) m in the first 0.1 s.
    assert listener.pushes[-1][1] == pytest.approx(0.01 * math.exp(-1.0))


def test_finger_that_lags_is_followed_to_a_stamp_that_is_ahead(listener):
    sensing = ActiveSensing(listener, FingerMotion(lag=0.1), BELT, 0.3)
    sensing.tick(1.0, math.nan, 0.0, 0.01)
    sensing.tick(1.1, 0.30, -0.05, 0.0)  # from 0.01 m/s the finger comes to rest
    sensing.tick(1.2, 0.31, -0.05, 0.01)
    # Rate x lag x what decays of it, from 50 to 150 ms after the stop. At 100 ms the finger begins
    # to follow the new command, in 50 ms for 0.01 (0.05 - 0.1 (1 - exp(-1/2))) m.
    rest = 0.01 * 0.1 * (math.exp(-0.5) - math.exp(-1.5))
    again = 0.01 * (0.05 - 0.1 * (1.0 - math.exp(-0.5)))
    assert listener.pushes[-1] == pytest.approx((0.31, (rest + again) / 0.1, BELT, 0.1))


ANYTHING = st.floats() | st.floats(-1.6, 1.6)
SENSIBLE = st.tuples(
    st.floats(0.0, 0.2), st.floats(-0.6, 0.6), st.floats(-0.3, 0.3), st.floats(-0.02, 0.02)
)
TICKS = st.lists(SENSIBLE | st.tuples(st.floats(-1e9, 1e9), ANYTHING, ANYTHING, ANYTHING))
TRIANGLE = [[-0.02, -0.02], [0.04, -0.02], [-0.02, 0.04]]


@pytest.mark.slow
@settings(max_examples=50, deadline=None)
@given(TICKS, st.booleans())
def test_whatever_it_is_told_its_intervals_are_in_order_and_within_the_edge(ticks, is_disk):
    estimator = (
        DiskEstimator(0.0285, 0.0035) if is_disk else ObjectEstimator(edges_of(TRIANGLE), 0.0035)
    )
    sensing, stamp = ActiveSensing(estimator, FingerMotion(), BELT, 0.3), 100.0
    for later, theta, silence, v_x in ticks:
        stamp += later
        values = sensing_values(sensing.tick(stamp, theta, silence, v_x), sensing)
        assert -0.085 < values['d_least'] <= values['d_lower'] <= values['d_upper']
        assert values['d_upper'] <= values['d_most'] < 0.085
        if values['readings']:
            assert math.isfinite(values['theta'])
        if not math.isnan(values['d']):
            assert values['d_least'] <= values['d'] <= values['d_most']


def test_push_is_told_with_how_fast_the_tip_turned_between_two_readings(sensing, listener):
    # Readings 20 ms, 70 ms and 0 ms old; the tip's direction may pass pi.
    sensing.tick(1.0, 0.30, 0.02, 0.001, 3.13)
    sensing.tick(1.1, 0.31, 0.07, 0.004, 3.14)
    sensing.tick(1.2, 0.32, 0.00, 0.002, 3.16 - 2.0 * math.pi)
    assert listener.spins == [0.0, pytest.approx(0.01 / 0.05), pytest.approx(0.02 / 0.17)]


@pytest.mark.parametrize(
    ('point', 'added'),
    [
        (CENTRE, 0.0),
        (POLE, 0.0135 * (math.cos(1.5) - math.cos(1.48))),  # it lies at r cos(psi)
        (CONTACT, 0.0135 * math.cos(0.3) * -0.02),  # its material goes by -r dpsi cos(theta) less
    ],
)
def test_way_is_that_of_the_disks_centre_whatever_point_is_commanded(listener, point, added):
    sensing = ActiveSensing(listener, FingerMotion(), BELT, 0.3, point=point, radius=0.0135)
    sensing.tick(1.0, 0.3, 0.0, 0.002, 1.5)
    sensing.tick(1.1, 0.3, 0.0, 0.002, 1.48)
    assert listener.pushes[-1][1] == pytest.approx(0.002 + added / 0.1)


def test_reading_without_the_tips_direction_makes_the_next_push_longer(sensing, listener):
    sensing.tick(1.0, 0.30, 0.0, 0.001, 1.50)
    sensing.tick(1.1, 0.31, 0.0, 0.003, math.nan)
    assert sensing.blind
    assert not sensing.took
    sensing.tick(1.2, 0.32, 0.0, 0.002, 1.52)
    assert not sensing.blind
    assert listener.pushes[1:] == [pytest.approx((0.32, 0.002, BELT, 0.2))]
    assert listener.spins[1:] == [pytest.approx(0.1)]
    assert listener.resets == 0


def blinded(without_psi):
    """Return active sensing after a push and then a second without the tip's direction."""
    estimator = DiskEstimator(0.0285, 0.0035)
    sensing = ActiveSensing(estimator, FingerMotion(), BELT, 0.3, without_psi=without_psi)
    forgot = []
    for k in range(13):
        psi = 1.5 if k < 3 else math.nan
        estimate = sensing.tick(0.1 * k, 0.1, 0.0, 0.001, psi)
        forgot.append(sensing.forgot)
    return sensing, estimate, forgot


def test_silent_it_says_that_the_direction_is_unknown_and_nothing_else():
    sensing, estimate, forgot = blinded(SILENT)
    assert forgot == [''] * 6 + [TIP_UNKNOWN] + [''] * 6  # later than 0.3 s after the last push
    assert sensing.readings == 0
    assert not sensing.took
    assert estimate.contradiction == BLIND
    values = sensing_values(estimate, sensing)
    assert CONTRADICTIONS[int(values['contradiction'])] == BLIND
    assert math.isnan(values['d'])
    told = sensing.tick(1.3, 0.1, 0.0, 0.001, 1.4)
    assert sensing.readings == 1
    assert told.contradiction == ''


def test_widened_it_takes_each_reading_for_the_first():
    sensing, estimate, forgot = blinded(WIDEN)
    assert forgot.count(TIP_UNKNOWN) == 2  # after 0.6 s and 1.0 s
    assert sensing.readings == 1
    assert estimate.contradiction == ''


def test_straight_tip_needs_no_direction():
    sensing, _, forgot = blinded(STRAIGHT)
    assert forgot == [''] * 13
    assert sensing.readings == 13


def test_straight_tip_is_as_before(listener):
    told, untold = Listener(), Listener()
    for heard, psi in ((told, (1.3,)), (untold, ())):
        sensing = ActiveSensing(heard, FingerMotion(), BELT, 0.3, point=CONTACT)
        for k in range(5):
            sensing.tick(0.1 * k, 0.3 - 0.01 * k, 0.013, 0.001 * k, *psi)
    assert told.pushes == untold.pushes
    assert told.spins == untold.spins == [0.0] * 5


def frozen(without_psi):
    """Return active sensing after joints that stood still for 1 s, and what it told of each tick.

    The finger was commanded to go at 4 mm/s in that time, and then stood as the joints said.
    """
    estimator = DiskEstimator(0.0285, 0.0035)
    sensing = ActiveSensing(estimator, FingerMotion(), BELT, 0.3, without_psi=without_psi)
    told = []
    for k in range(40):
        estimate = sensing.tick(0.1 * k, 0.1, 0.0, 0.004 if k < 10 else 0.0, 1.5, 0.02)
        told.append((estimate.contradiction, sensing.forgot, sensing.blind))
    return sensing, told


def test_silent_it_says_that_the_joints_do_not_add_up_until_they_do():
    sensing, told = frozen(SILENT)
    silent = [contradiction == DISOBEYED for contradiction, _, _ in told]
    first = silent.index(True)
    assert 3 < first < 10
    assert all(silent[first:10])
    assert not any(silent[30:])
    assert [forgot for _, forgot, _ in told].count(JOINTS_DOUBTED) == 1
    assert told[first][1] == JOINTS_DOUBTED
    assert sensing.readings == 40


def test_widened_it_takes_readings_for_the_first_while_the_joints_do_not_add_up():
    _, told = frozen(WIDEN)
    assert not any(contradiction for contradiction, _, _ in told)
    doubted = [blind == DISOBEYED for _, _, blind in told]
    assert all(doubted[9:11])
    assert not any(doubted[30:])


def test_straight_tip_does_not_ask_the_joints():
    _, told = frozen(STRAIGHT)
    assert [(forgot, blind) for _, forgot, blind in told] == [('', '')] * 40
    assert DISOBEYED not in [contradiction for contradiction, _, _ in told]


def test_way_of_a_push_is_corrected_by_the_joints(sensing, listener):
    for k in range(60):  # the finger goes at 1.2 mm/s
        sensing.tick(0.1 * k, 0.3, 0.0, 0.001, 1.5, 0.00012 * k)
    assert listener.pushes[1][1] > 0.001
    assert listener.pushes[-1][1] == pytest.approx(0.0012, rel=1e-3)


def apart(sensing, begin, count, v_x=0.0, theta=0.1):
    """Tick while the finger is off the object, without a new reading."""
    for k in range(count):
        at = begin + k
        sensing.tick(at * PERIOD, theta, (k + 1) * PERIOD, v_x, apart=True)


def test_the_first_reading_after_the_finger_was_apart_is_of_another_contact(sensing, listener):
    sensing.tick(0.0, 0.1, 0.0, 0.0)
    sensing.tick(0.1, 0.12, 0.0, 0.002, apart=True)  # which it is about to be
    apart(sensing, 2, 20, 0.01)
    assert (sensing.forgot, sensing.took, sensing.readings) == ('', False, 2)
    sensing.tick(2.2, 0.13, 0.02, 0.001)
    assert (sensing.forgot, sensing.took, sensing.readings) == ('', True, 3)
    # From 0.1 s on at 2 mm/s, from 0.2 s on at 10 mm/s.
    ((theta, way, unfelt),) = listener.touches
    assert (theta, way) == pytest.approx((0.13, 0.002 * 0.1 + 0.01 * (2.18 - 0.2)))
    assert unfelt == pytest.approx(2.0 * 0.1 * BELT)  # two control periods, at the most
    sensing.tick(2.3, 0.14, 0.02, 0.001)
    assert listener.pushes[-1] == pytest.approx((0.14, 0.001 + 0.2 * 0.009, BELT, 0.1))
    assert listener.resets == 0


def test_what_is_felt_while_the_finger_is_apart_is_left_out(sensing, listener):
    sensing.tick(0.0, 0.1, 0.0, 0.0, apart=True)
    sensing.tick(0.1, 0.2, 0.0, 0.0, apart=True)
    assert not sensing.took
    assert len(listener.pushes) == 1


def test_if_the_finger_is_not_apart_any_more_and_feels_nothing_all_is_forgotten(sensing):
    sensing.tick(0.0, 0.1, 0.0, 0.0, apart=True)
    sensing.tick(0.1, 0.1, 0.1, 0.0, apart=True)
    sensing.tick(0.2, 0.1, 0.2, 0.0)
    assert sensing.forgot == CONTACT_LOST
    assert sensing.readings == 0


@pytest.mark.parametrize(
    ('tick', 'reason'),
    [((3.0, 0.1, 0.01, 0.0), TICKS_MISSING), ((0.05, 0.1, 0.01, 0.0), TIME_WENT_BACK)],
)
def test_a_finger_that_is_apart_is_followed_without_a_gap(sensing, tick, reason):
    sensing.tick(0.0, 0.1, 0.0, 0.0, apart=True)
    sensing.tick(0.1, 0.1, 0.1, 0.0, apart=True)
    sensing.tick(*tick, apart=True)
    assert sensing.forgot == reason


def test_a_finger_that_somebody_else_moved_while_it_was_apart_is_forgotten(sensing):
    sensing.tick(0.0, 0.1, 0.0, 0.0, apart=True)
    sensing.tick(0.1, 0.1, 0.1, math.nan, apart=True)
    sensing.tick(0.2, 0.1, 0.2, 0.0, apart=True)
    assert sensing.forgot == MOTION_UNKNOWN
