# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Without a record of the controller the law ticks by itself."""

from support.bag_clock import BEGIN, EPOCH, PERIOD, seconds, stamp_of
from tactile_push.control import INACTIVE, PUSHING, STATES
from tactile_push.parameters.push_controller import PushControllerParameters, make_control
from tactile_push.replay.own_ticks import OwnTicks


def test_without_a_record_the_law_ticks_at_its_own_rate_from_the_first_contact_on():
    own = OwnTicks(PushControllerParameters(), EPOCH)
    control = make_control(PushControllerParameters())
    ticks, expected = [], []
    for k in range(41):  # every 50 ms
        at = BEGIN * 10**9 + k * 50_000_000
        ticks += own.feel(0.3 - 0.005 * k, stamp_of(at), at)
    control.activate(seconds(BEGIN * 10**9))
    for k in range(20):
        at = BEGIN * 10**9 + 2 * k * 50_000_000
        control.feel(0.3 - 0.005 * 2 * k, seconds(at))
        expected.append(control.tick(seconds(at)).v_x)
    assert [tick.tick.v_x for tick in ticks] == expected
    assert [tick.stamp for tick in ticks] == [
        stamp_of(BEGIN * 10**9 + k * 100_000_000) for k in range(20)
    ]


def test_without_contacts_there_is_nothing_to_tick_on_and_silence_stops():
    own = OwnTicks(PushControllerParameters(), EPOCH)
    begin = BEGIN * 10**9
    assert not list(own.feel(None, stamp_of(begin), begin))
    assert not list(own.feel(0.2, stamp_of(begin + 1), begin))
    ticks = list(own.feel(None, stamp_of(begin + 10 * PERIOD), begin))
    assert [tick.tick.state for tick in ticks[:4]] == [PUSHING] * 4
    assert all(tick.tick.v_x == 0.0 for tick in ticks[4:])
    assert INACTIVE in STATES
