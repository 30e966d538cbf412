# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Whatever happened to a controller, its ticks come out again."""

import math
from types import SimpleNamespace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support.bag_clock import BEGIN, EPOCH, PERIOD, seconds, stamp_of
from tactile_push.control import FINGER_UNKNOWN, NO_REASON, tick_values
from tactile_push.parameters.push_controller import PushControllerParameters, make_control
from tactile_push.replay.controller import ReplayedController

CHECKED = settings(derandomize=True, deadline=None, max_examples=150)


def named_values(values, sec, nanosec):
    """Give a message as it is read from a bag."""
    header = SimpleNamespace(stamp=SimpleNamespace(sec=sec, nanosec=nanosec))
    return SimpleNamespace(header=header, name=list(values), position=list(values.values()))


class Live:
    """A controller as its node runs it, and what a bag would hold of it."""

    def __init__(self, simulated=False, **given):
        self.simulated = simulated
        self.control = make_control(PushControllerParameters.of(given))
        self.now = BEGIN * 10**9 + 123_456_789
        self.steady = 17.0
        self.before = math.nan
        self.expected = math.inf  # when the finger's position is due, for joint states came [s]
        self.heard = []  # (log time, what, theta, stamp), (log time, what, message)
        self.ticks = []
        self.activate()

    def activate(self):
        self.control.activate(seconds(self.now))
        self.before = math.nan

    def deactivate(self):
        self.record(self.control.deactivate())

    def contact(self, theta, age):
        at = self.now - age
        self.control.feel(theta, seconds(at))
        self.heard.append((self.now - age // 2, 'contact', theta, stamp_of(at)))

    def position(self, x, age):
        self.control.locate_finger(x, seconds(self.now - age), 1.5 - 12.0 * x)

    def tick(self):
        self.steady += 0.1
        elapsed = math.nan if self.simulated else self.steady - self.before
        self.before = self.steady
        self.control.expect_finger(self.expected)
        self.record(self.control.tick(seconds(self.now), elapsed))
        self.now += PERIOD

    def record(self, tick):
        sec, nanosec = stamp_of(self.now)
        message = named_values(tick_values(tick, self.control.law), sec, nanosec)
        self.heard.append((self.now + 1000, 'state', message))
        self.ticks.append((stamp_of(self.now), tick))

    def jump(self, nanoseconds):
        self.now += nanoseconds
        self.control.notice_clock_jump(seconds(self.now))

    def wait(self, periods):
        """Stand still for a while."""
        self.now += periods * PERIOD
        self.steady += periods * 0.1


def replayed(live, start=0, overridden=(), **given):
    """Give the ticks of a bag that begins at an entry of what was heard."""
    controller = ReplayedController(PushControllerParameters.of(given), overridden, EPOCH)
    ticks = []
    for log_time, what, *rest in live.heard[start:]:
        if what == 'contact':
            ticks += controller.feel(*rest, log_time)
        else:
            ticks += controller.state(*rest, log_time)
    return [*ticks, *controller.finish()]


def same(replayed, lived):
    """Compare ticks to the bit, NaN with NaN."""
    return [(r.stamp, repr(r.tick)) for r in replayed] == [(s, repr(t)) for s, t in lived]


THETA = st.floats(-1.2, 1.2)
AGE = st.integers(1_000_000, 99_000_000)
EVENTS = st.one_of(
    st.tuples(st.just('contact'), THETA, AGE),
    st.tuples(st.just('contact'), THETA, AGE),
    st.tuples(st.just('contact'), THETA, AGE),
    st.tuples(st.just('contact'), st.just(math.nan), AGE),
    st.tuples(st.just('position'), st.floats(-0.11, 0.11), AGE),
    st.tuples(st.just('joints of no use')),
    st.tuples(st.just('tick')),
    st.tuples(st.just('tick')),
    st.tuples(st.just('another')),
    st.tuples(st.just('resume')),
    st.tuples(st.just('jump'), st.sampled_from([-3_600_000_000_000, 1_000_000_000])),
    st.tuples(st.just('wait'), st.integers(1, 6)),
    st.tuples(st.just('restart')),
)


def happen(live, events):
    """Let things happen, one control period after another."""
    ages = []
    for what, *how in events:
        if what == 'contact':
            ages.append((how[1], how[0]))
            continue
        for age, theta in sorted(ages, reverse=True):  # as they arrive, the oldest first
            live.contact(theta, age)
        ages = []
        if what == 'position':
            live.position(*how)
        elif what == 'joints of no use':
            live.expected = min(live.expected, seconds(live.now) + 0.3)
        elif what == 'another':
            live.control.notice_another_command()
        elif what == 'resume':
            live.control.resume()
        elif what == 'jump' and live.ticks:
            live.jump(*how)
        elif what == 'wait':
            live.wait(*how)
        elif what == 'restart' and live.ticks:
            live.deactivate()
            live.activate()
        if what != 'tick':
            continue
        live.tick()


@pytest.mark.slow
@CHECKED
@given(
    events=st.lists(EVENTS, min_size=10, max_size=80),
    simulated=st.booleans(),
    trim=st.sampled_from([0.0, 0.5]),
)
def test_whatever_happened_comes_out_again_to_the_bit(events, simulated, trim):
    live = Live(simulated, steadying_max=trim)
    # One thing a control period at the most that is no reading.
    happen(live, [step for event in events for step in (event, ('tick',)) if event[0] != 'tick'])
    assert same(replayed(live, steadying_max=trim), live.ticks)


def test_a_finger_that_was_never_known_though_joint_states_came_stops_again():
    live = Live()
    live.expected = seconds(live.now) + 0.3
    for k in range(8):
        live.contact(0.3, 60_000_000)
        live.tick()
        if k == 5:
            live.position(0.01, 10_000_000)
    reasons = [tick.stop_reason for _, tick in live.ticks]
    assert reasons == [NO_REASON] * 4 + [FINGER_UNKNOWN] * 2 + [NO_REASON] * 2
    assert same(replayed(live), live.ticks)


def pushing(periods=20, **given):
    live = Live(**given)
    for k in range(periods):
        live.contact(0.3 - 0.01 * k, 60_000_000)
        live.contact(0.3 - 0.01 * k - 0.003, 10_000_000)
        live.position(0.001 * k, 5_000_000)
        live.tick()
    return live


@pytest.mark.parametrize('trim', [0.0, 0.4])
@pytest.mark.parametrize('cut', range(1, 20))
def test_a_bag_that_begins_in_the_middle_is_followed_from_the_second_push_on(cut, trim):
    live = pushing(steadying_max=trim)
    assert (live.ticks[-1][1].trim != 0.0) == (trim > 0.0)
    ticks = replayed(live, start=cut, steadying_max=trim)
    kept = [tick for tick in ticks if tick.tick is None]
    assert len(kept) <= 3
    followed = ticks[len(kept) :]
    assert same(followed, live.ticks[-len(followed) :])
    assert len(followed) >= len(live.ticks) - cut // 3 - 4


@pytest.mark.parametrize('late', [350_000_000, 40_000_000_000])  # by the clock or its simulation
def test_contacts_recorded_after_the_tick_that_used_them_are_waited_for(late):
    live = pushing()
    live.heard = [
        (at + (late if what == 'contact' else 0), what, *rest) for at, what, *rest in live.heard
    ]
    live.heard.sort(key=lambda entry: entry[0])
    assert same(replayed(live), live.ticks)


def test_tick_whose_contact_is_missing_does_not_keep_the_others_waiting_for_ever():
    live = pushing(30)
    missing = [k for k, entry in enumerate(live.heard) if entry[1] == 'contact'][21]
    del live.heard[missing]
    ticks = replayed(live)
    assert [tick.stamp for tick in ticks] == [stamp for stamp, _ in live.ticks]
    assert repr(ticks[9].tick) == repr(live.ticks[9][1])
    assert ticks[10].tick.theta == live.heard[20 + 10][2] or ticks[10].tick != live.ticks[10][1]


def test_other_gains_give_what_a_controller_with_them_would_have_commanded():
    live, other = pushing(kd=5.0), pushing(kd=2.0)
    ticks = replayed(live, overridden=['kd'], kd=2.0)
    assert [t.tick.v_x for t in ticks] == [tick.v_x for _, tick in other.ticks]
    assert [t.recorded.v_x for t in ticks] == [tick.v_x for _, tick in live.ticks]


def test_another_desired_angle_is_not_trimmed_by_what_was_felt_under_the_old_one():
    live, other = pushing(steadying_max=0.4), pushing(theta_desired=0.1)
    ticks = replayed(live, overridden=['theta_desired'], theta_desired=0.1, steadying_max=0.4)
    assert [t.tick.v_x for t in ticks] == [tick.v_x for _, tick in other.ticks]
    assert {t.tick.trim for t in ticks} == {0.0}


def test_a_trim_that_was_changed_while_the_node_ran_comes_out_again():
    live = pushing(10, steadying_max=0.4)
    live.control.steadying.bound = 0.01
    before = len(live.heard)
    for k in range(10, 20):
        live.contact(0.2 - 0.01 * k, 10_000_000)
        live.position(0.001 * k, 5_000_000)
        live.tick()
    controller = ReplayedController(PushControllerParameters(steadying_max=0.4), (), EPOCH)
    ticks = []
    for at, (log_time, what, *rest) in enumerate(live.heard):
        if at == before:
            controller.change({'steadying_max': 0.01})
        ticks += (controller.feel if what == 'contact' else controller.state)(*rest, log_time)
    assert same([*ticks, *controller.finish()], live.ticks)


def test_a_record_without_the_later_fields_can_be_followed():
    live = pushing()
    old = []
    for log_time, what, *rest in live.heard:
        if what == 'state':
            message = rest[0]
            rest = [
                SimpleNamespace(
                    header=message.header, name=message.name[:-4], position=message.position[:-4]
                )
            ]
        old.append((log_time, what, *rest))
    live.heard = old
    assert [t.tick.v_x for t in replayed(live)] == [tick.v_x for _, tick in live.ticks]
