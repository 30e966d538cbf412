# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The player's node: a bag in, its messages out under the names that were asked for."""

from pathlib import Path

import pytest
from geometry_msgs.msg import TwistStamped
from std_srvs.srv import SetBool, Trigger

from tactile_push.bags import BagReader
from tactile_push.nodes.bag_player import BagPlayer
from tactile_push.nodes.ros.diagnostics import OK, WARN
from tactile_push.nodes.ros.parameters import ConfigurationError
from tactile_push.pipeline.stamps import stamp_of

BAG = Path(__file__).parents[1] / 'data/block'
COMMANDS = {'bag': BAG, 'topics': ['finger/cmd_vel'], 'start_paused': True}


@pytest.fixture(scope='module')
def recorded():
    """Return stamp and velocity of the first commands in the bag."""
    with BagReader(BAG) as bag:
        messages = map(bag.decode, bag.messages(['/finger/cmd_vel']))
        return [
            (stamp_of(message), message.twist.linear.x)
            for message, _ in zip(messages, range(3), strict=False)
        ]


def step(node):
    return node._on_step(Trigger.Request(), Trigger.Response())


def test_a_paused_play_publishes_a_message_a_step(bench, recorded):
    node = bench.start(BagPlayer, **COMMANDS)
    assert bench.health == (WARN, 'waiting for subscribers')
    assert bench.topics() == ({'finger/cmd_vel'}, set())
    bench.hear(TwistStamped, 'finger/cmd_vel')
    bench.until(lambda: not node._player.waiting)
    assert bench.health == (OK, 'paused')
    for _ in range(3):
        answer = step(node)
        assert (answer.success, answer.message) == (True, '/finger/cmd_vel')
    heard = bench.heard['finger/cmd_vel']
    bench.until(lambda: len(heard) == 3)
    assert [(stamp_of(message), message.twist.linear.x) for message in heard] == recorded


def test_a_topic_is_published_under_its_new_name(bench, recorded):
    node = bench.start(BagPlayer, **COMMANDS, remap=['finger/cmd_vel:=old/cmd_vel'])
    assert bench.topics() == ({'old/cmd_vel'}, set())
    bench.hear(TwistStamped, 'old/cmd_vel')
    bench.until(lambda: not node._player.waiting)
    step(node)
    bench.until(lambda: bench.heard['old/cmd_vel'])
    assert stamp_of(bench.heard['old/cmd_vel'][0]) == recorded[0][0]


def test_a_play_that_goes_on_takes_no_step(bench):
    node = bench.start(BagPlayer, **COMMANDS, rate=0.01)
    bench.hear(TwistStamped, 'finger/cmd_vel')
    bench.until(lambda: not node._player.waiting)
    answer = node._on_pause(SetBool.Request(data=False), SetBool.Response())
    assert answer.success
    assert answer.message.startswith('playing, 0.')
    assert answer.message.endswith(' s of 24.3 s')
    refused = step(node)
    assert not refused.success
    assert refused.message.startswith('playing, ')
    answer = node._on_pause(SetBool.Request(data=True), SetBool.Response())
    assert answer.message.startswith('paused, ')


@pytest.mark.parametrize(
    ('parameters', 'refusal'),
    [
        ({'bag': ''}, "parameter bag: expected the folder of a bag, got ''"),
        ({'bag': BAG.parent / 'no'}, str(BAG.parent / 'no')),
        ({'topics': ['no/such']}, str(BAG)),
        ({'rate': 0.0}, 'parameter rate: expected'),
        ({'remap': ['finger/cmd_vel']}, 'parameter remap: expected OLD:=NEW, got'),
        (
            {'remap': ['contact:=other']},
            'parameter remap: expected a topic that is played, got /contact',
        ),
        ({'remap': ['finger/cmd_vel:=no name']}, 'parameter remap: expected the name of a topic'),
        (
            {'topics': ['contact', 'finger/cmd_vel'], 'remap': ['contact:=finger/cmd_vel']},
            'parameter remap: expected different names, got /finger/cmd_vel for 2 topics',
        ),
        (
            {'clock': 10.0, 'remap': ['finger/cmd_vel:=/clock']},
            'parameter remap: expected different names, got /clock for 2 topics',
        ),
    ],
)
def test_what_cannot_be_played_is_refused(bench, parameters, refusal):
    with pytest.raises(ConfigurationError) as refused:
        bench.start(BagPlayer, **{**COMMANDS, **parameters})
    assert str(refused.value).startswith(refusal)
