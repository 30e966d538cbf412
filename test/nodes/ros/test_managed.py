# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A managed node does what its state allows, and outlives being asked for anything else."""

import pytest

rclpy = pytest.importorskip('rclpy')

from lifecycle_msgs.msg import Transition  # noqa: E402
from lifecycle_msgs.srv import ChangeState  # noqa: E402
from rclpy.context import Context  # noqa: E402
from rclpy.executors import SingleThreadedExecutor  # noqa: E402
from rclpy.lifecycle import TransitionCallbackReturn  # noqa: E402

from tactile_push.nodes.ros.managed import ManagedNode  # noqa: E402
from tactile_push.nodes.ros.parameters import ConfigurationError  # noqa: E402
from tactile_push.testing.processes import claim_domain  # noqa: E402


@pytest.fixture
def context(monkeypatch):
    """Make a context that nodes take for that of their process."""
    context = Context()
    domain, lock = claim_domain()
    rclpy.init(context=context, domain_id=domain)
    monkeypatch.setattr('rclpy.node.get_default_context', lambda: context)
    yield context
    rclpy.shutdown(context=context)
    lock.close()


@pytest.fixture
def ask(context):
    """Return what asks a node's service for a transition, spinning both ends."""
    node = ManagedNode('managed')
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    client = node.create_client(ChangeState, 'managed/change_state')

    def ask(transition=0, label=''):
        request = ChangeState.Request(transition=Transition(id=transition, label=label))
        future = client.call_async(request)
        executor.spin_until_future_complete(future, timeout_sec=30.0)
        return future.result().success

    yield ask
    executor.shutdown()
    node.destroy_node()


class Told(ManagedNode):
    """A managed node whose transitions end as told."""

    def __init__(self, configure, activate):
        super().__init__('managed')
        self.results = {'configure': configure, 'activate': activate}
        self.calls = []

    def on_configure(self, state):
        self.calls.append('configure')
        return self.results['configure']

    def on_activate(self, state):
        self.calls.append('activate')
        return self.results['activate']


SUCCESS, FAILURE = TransitionCallbackReturn.SUCCESS, TransitionCallbackReturn.FAILURE


def test_autostart_configures_and_activates(context):
    node = Told(SUCCESS, SUCCESS)
    node.autostart()
    assert node.calls == ['configure', 'activate']
    node.destroy_node()


@pytest.mark.parametrize(
    ('configure', 'activate', 'calls'),
    [(FAILURE, SUCCESS, ['configure']), (SUCCESS, FAILURE, ['configure', 'activate'])],
)
def test_autostart_that_fails_is_a_refusal(context, configure, activate, calls):
    node = Told(configure, activate)
    with pytest.raises(ConfigurationError):
        node.autostart()
    assert node.calls == calls
    node.destroy_node()


def test_transitions_of_the_state_are_made_and_others_refused(ask):
    assert not ask(Transition.TRANSITION_ACTIVATE)
    assert not ask(Transition.TRANSITION_DEACTIVATE)
    assert ask(Transition.TRANSITION_CONFIGURE)
    assert not ask(Transition.TRANSITION_CONFIGURE)
    assert ask(Transition.TRANSITION_ACTIVATE)
    assert not ask(Transition.TRANSITION_CLEANUP)
    assert ask(Transition.TRANSITION_DEACTIVATE)
    assert ask(Transition.TRANSITION_CLEANUP)


def test_transitions_are_known_by_their_labels_too(ask):
    assert not ask(label='activate')
    assert ask(label='configure')
    assert ask(label='activate')
    assert not ask(label='nonsense')
    assert ask(label='shutdown')
    for label in ('configure', 'activate', 'shutdown'):
        assert not ask(label=label)


@pytest.mark.parametrize('transition', [0, 8, 99, 255])
def test_transition_that_nobody_knows_is_refused(ask, transition):
    assert not ask(transition)
    assert ask(Transition.TRANSITION_CONFIGURE)
