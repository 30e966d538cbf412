# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a node says of itself: once a second, and at once when the level changes."""

import time
import uuid

import pytest

rclpy = pytest.importorskip('rclpy')

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus  # noqa: E402
from rclpy.context import Context  # noqa: E402
from rclpy.executors import SingleThreadedExecutor  # noqa: E402

from tactile_push.nodes.ros.diagnostics import ERROR, OK, WARN, Diagnostics, Health  # noqa: E402
from tactile_push.testing.processes import claim_domain  # noqa: E402

PATIENCE = 30.0  # [s]


class Patient:
    """A node whose health the test decides, and what it publishes."""

    def __init__(self):
        self.context = Context()
        domain, self.lock = claim_domain()
        rclpy.init(context=self.context, domain_id=domain)
        self.namespace = f'test_{uuid.uuid4().hex}'
        self.node = rclpy.create_node('patient', context=self.context, namespace=self.namespace)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)
        self.health = Health(OK, 'fine')
        self.counts = {}
        self.published = []
        self.node.create_subscription(DiagnosticArray, '/diagnostics', self._receive, 10)
        self.diagnostics = Diagnostics(self.node, lambda: self.health, lambda: self.counts)
        # Count what is sent, besides what arrives: the topic is everybody's.
        publisher = self.diagnostics._publisher
        self.sent = []
        send = publisher.publish
        publisher.publish = lambda message: (self.sent.append(message), send(message))

    def _receive(self, message):
        if message.status and message.status[0].name.startswith(self.namespace):
            self.published.append(message)

    def spin_until(self, condition):
        """Run the node until the condition holds."""
        deadline = time.monotonic() + PATIENCE
        while not condition():
            assert time.monotonic() < deadline, 'the condition did not come true'
            self.executor.spin_once(timeout_sec=0.02)


@pytest.fixture
def patient():
    """Return the node."""
    patient = Patient()
    yield patient
    patient.executor.shutdown()
    patient.node.destroy_node()
    rclpy.shutdown(context=patient.context)
    patient.lock.close()


def levels(messages):
    return [message.status[0].level for message in messages]


def values(message):
    return {item.key: item.value for item in message.status[0].values}


def test_levels_are_those_of_the_message():
    assert (OK, WARN, ERROR) == (b'\x00', b'\x01', b'\x02')
    assert DiagnosticStatus.ERROR == ERROR


def test_message_says_who_how_and_what(patient):
    patient.health = Health(WARN, 'a bit ill', {'fever [K]': 312.5, 'times': 3, 'since': None})
    patient.diagnostics.report()
    patient.spin_until(lambda: patient.published)
    message = patient.published[0]
    (status,) = message.status
    assert status.level == WARN
    assert status.name == f'{patient.namespace}/patient'
    assert status.message == 'a bit ill'
    assert values(message) == {
        'fever [K]': '312.5',
        'times': '3',
        'since': 'None',
        'time in state [s]': '0.0',
    }
    now = patient.node.get_clock().now().nanoseconds * 1e-9
    stamp = message.header.stamp.sec + message.header.stamp.nanosec * 1e-9
    assert 0.0 <= now - stamp < PATIENCE


def test_change_of_level_is_published_at_once_and_no_other(patient):
    patient.diagnostics.update()
    assert levels(patient.sent) == [OK]
    for _ in range(3):
        patient.diagnostics.update()
    assert levels(patient.sent) == [OK]
    patient.health = Health(ERROR, 'broken')
    patient.diagnostics.update()
    patient.diagnostics.update()
    assert levels(patient.sent) == [OK, ERROR]
    patient.health = Health(WARN, 'mending')
    patient.diagnostics.update()
    patient.health = Health(OK, 'fine')
    patient.diagnostics.update()
    patient.diagnostics.update()
    assert levels(patient.sent) == [OK, ERROR, WARN, OK]


def test_other_words_at_the_same_level_wait_for_their_turn(patient):
    patient.diagnostics.update()
    patient.health = Health(OK, 'fine, in other words', {'more': 1})
    patient.diagnostics.update()
    assert len(patient.sent) == 1


def test_health_is_published_once_a_second_without_being_asked(patient):
    start = time.monotonic()
    patient.spin_until(lambda: len(patient.sent) >= 3)  # the first one is the change to OK
    assert time.monotonic() - start > 1.8
    patient.spin_until(lambda: len(patient.published) >= 2)
    assert levels(patient.published[:2]) == [OK, OK]


def test_change_of_level_is_seen_without_being_asked_long_before_the_next_report(patient):
    patient.spin_until(lambda: patient.sent)
    patient.spin_until(lambda: len(patient.sent) == 2)  # a whole second to the next one
    patient.health = Health(ERROR, 'broken')
    broken = time.monotonic()
    patient.spin_until(lambda: len(patient.sent) == 3)
    assert levels(patient.sent)[-1] == ERROR
    assert time.monotonic() - broken < 0.8  # a tenth of a second, and a loaded machine


def test_counts_are_reported_with_how_often_they_happen_a_second(patient):
    patient.counts = {'readings': 100}
    patient.diagnostics.report()
    patient.counts = {'readings': 150, 'dropped: noise': 5}
    before = time.monotonic()
    while time.monotonic() - before < 0.25:
        time.sleep(0.01)
    patient.diagnostics.report()
    elapsed = time.monotonic() - before
    said = values(patient.sent[-1])
    assert (said['readings'], said['dropped: noise']) == ('150', '5')
    # Between the shortest and the longest time that may have passed between the two reports.
    assert 50 / (elapsed + 0.2) - 0.1 < float(said['readings [1/s]']) <= 50 / 0.25
    assert patient.diagnostics.rates['dropped: noise'] == pytest.approx(
        patient.diagnostics.rates['readings'] / 10.0
    )
    assert patient.diagnostics.rates['never'] == 0.0
    patient.diagnostics.report()
    assert patient.diagnostics.rates['readings'] == 0.0


def test_time_in_state_starts_over_when_the_words_change(patient):
    patient.diagnostics.report()
    before = time.monotonic()
    while time.monotonic() - before < 0.3:
        time.sleep(0.01)
    patient.diagnostics.report()
    assert float(values(patient.sent[-1])['time in state [s]']) >= 0.3
    patient.health = Health(OK, 'better')
    patient.diagnostics.report()
    assert values(patient.sent[-1])['time in state [s]'] == '0.0'


def test_periodic_report_counts_as_the_last_level(patient):
    patient.diagnostics.update()
    patient.health = Health(ERROR, 'broken')
    patient.diagnostics.report()
    patient.diagnostics.update()
    assert levels(patient.sent) == [OK, ERROR]


def test_health_of_a_node_that_does_not_run_yet_is_announced(patient):
    patient.diagnostics.announce(Health(WARN, 'compiling'))
    patient.diagnostics.announce(Health(WARN, 'compiling'))
    assert [message.status[0].message for message in patient.sent] == ['compiling'] * 2
    patient.diagnostics.update()
    assert levels(patient.sent) == [WARN, WARN, OK]


def test_values_are_empty_unless_given():
    assert dict(Health(OK, 'fine').values) == {}


def test_error_is_logged_once_and_so_is_its_end(patient, monkeypatch):
    logged = []
    for severity in ('error', 'info'):
        monkeypatch.setattr(
            patient.node.get_logger(), severity, lambda text, s=severity: logged.append((s, text))
        )
    for health in (
        Health(OK, 'fine'),
        Health(ERROR, 'broken'),
        Health(ERROR, 'broken in another way'),
        Health(WARN, 'mending'),
        Health(OK, 'fine'),
    ):
        patient.health = health
        patient.diagnostics.report()
    assert logged == [('error', 'broken'), ('info', 'mending')]


def test_error_that_is_over_by_the_next_report_is_not_logged(patient, monkeypatch):
    logged = []
    monkeypatch.setattr(patient.node.get_logger(), 'error', logged.append)
    patient.health = Health(ERROR, 'a moment')
    patient.diagnostics.update()
    patient.health = Health(OK, 'fine')
    patient.diagnostics.report()
    assert logged == []
