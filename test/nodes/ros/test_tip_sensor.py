# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What every sensor in the tip does with its messages; the real ones are tested beside this."""

import math
import time
from types import SimpleNamespace

import pytest
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from std_srvs.srv import Trigger

from tactile_push.interface import TACTILE, WRENCH_SENSOR
from tactile_push.nodes.ros.diagnostics import ERROR, OK, WARN
from tactile_push.nodes.ros.qos import SENSOR_DATA
from tactile_push.nodes.ros.tip_sensor import PATIENCE, TipSensor
from tactile_push.pipeline.messages import tactile_fields
from tactile_push.tactile import NO_CONTACT, NotUntouchedError, Reading

CONTACT = SimpleNamespace(reading=Reading(0.5, 1.2))


class Words(TipSensor):
    """A sensor that is told in a word what to make of it."""

    NAME = WRENCH_SENSOR
    MESSAGES = 'words'
    SERVICE = 'words/rest'
    TAKEN, NOT_TAKEN = 'rested', 'not rested'
    _topic = 'words'

    def __init__(self):
        super().__init__()
        self._settings = SimpleNamespace(silence_timeout=60.0, autostart=True)
        self.rests = []
        self.known = True
        self._begin()

    def _forget_untouched(self):
        self.rests = []

    def _subscribe(self):
        self.make_subscription(String, 'words', self._on_message, SENSOR_DATA)

    def _came_of(self, message):
        told = {'contact': CONTACT, 'air': SimpleNamespace(reading=NO_CONTACT)}.get(message.data)
        refusal = '' if told or message.data == 'early' else message.data

        def outputs():
            if told is not None:
                yield TACTILE, tactile_fields((5, 0), told.reading)

        return SimpleNamespace(told=told, refusal=refusal, outputs=outputs)

    def _take_untouched(self):
        if self._told is CONTACT:
            raise NotUntouchedError('in contact')
        self.rests.append(self._told)

    def _ignorance(self):
        return '' if self.known else 'never rested'

    def _values(self):
        return {}


@pytest.fixture
def node(bench):
    return bench.start(Words)


def rest(node):
    response = node._on_untouched(Trigger.Request(), Trigger.Response())
    return response.success, response.message


def test_readings_are_published_and_told(bench, node):
    bench.hear(JointState, TACTILE)
    words = bench.publisher(String, 'words')
    assert bench.health == (WARN, 'no reading yet')
    bench.until(
        lambda: bench.health == (OK, 'contact'), lambda: words.publish(String(data='contact'))
    )
    bench.until(lambda: bench.heard[TACTILE])
    assert list(bench.heard[TACTILE][0].position[:2]) == [0.5, 1.2]
    bench.until(
        lambda: bench.health == (OK, 'no contact'), lambda: words.publish(String(data='air'))
    )
    bench.until(lambda: math.isnan(bench.heard[TACTILE][-1].position[0]))


def test_message_that_tells_nothing_yet_is_useful(bench, node):
    for word in ('contact', 'early'):
        node._on_message(String(data=word))
    assert node._told is CONTACT
    assert (node._counted['words'], node._counted['readings']) == (2, 1)
    assert not any(name.startswith('refused') for name in node._counted)


def test_silence_is_an_error_and_patience_starts_over_after_it(bench, node):
    node._settings.silence_timeout = 0.1
    bench.until(lambda: bench.health == (ERROR, 'no words on words'))
    node._settings.silence_timeout = 60.0
    node._heard = node._useful = time.monotonic() - 2.0 * PATIENCE
    node._on_message(String(data='nonsense'))
    assert node._useful == node._heard  # so nothing has been refused for long
    bench.until(
        lambda: bench.health == (ERROR, 'words refused: nonsense'),
        lambda: node._on_message(String(data='nonsense')),
    )
    assert node._counted['refused: nonsense'] >= 2


def test_some_refused_messages_are_a_warning(bench, node):
    node._on_message(String(data='contact'))
    node._diagnostics.rates['refused: nonsense'] = 1.0
    assert bench.health == (WARN, 'contact, some words refused')


def test_node_that_does_not_know_the_untouched_tip_says_what_to_do(bench, node):
    node.known = False
    assert bench.health == (ERROR, 'never rested: lift the finger and call words/rest')


def test_untouched_tip_is_taken_unless_something_speaks_against_it(bench, node):
    node._on_message(String(data='air'))
    assert rest(node) == (True, '')
    assert len(node.rests) == 1
    node._on_message(String(data='contact'))
    assert rest(node) == (False, 'in contact')
    node._heard = -math.inf
    assert rest(node) == (False, 'no words on words')
    node.trigger_deactivate()
    assert rest(node) == (False, 'the node is not active')
    assert len(node.rests) == 1


def test_inactive_node_hears_nothing_and_a_new_configuration_forgets(bench, node):
    node._on_message(String(data='contact'))
    node.rests.append('kept')
    node.trigger_deactivate()
    node._on_message(String(data='contact'))
    assert node._counted['words'] == 1
    assert bench.health == (OK, 'inactive')
    node.trigger_cleanup()
    node.trigger_configure()
    assert (node._told, node.rests) == (None, [])
