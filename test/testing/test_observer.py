# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What an observer hears, calls and waits for, with the other nodes in the same process."""

from types import SimpleNamespace

import pytest

rclpy = pytest.importorskip('rclpy')

from lifecycle_msgs.msg import Transition  # noqa: E402
from lifecycle_msgs.srv import ChangeState  # noqa: E402
from rcl_interfaces.msg import SetParametersResult  # noqa: E402
from rclpy.context import Context  # noqa: E402
from rclpy.node import Node  # noqa: E402
from rclpy.utilities import get_default_context  # noqa: E402
from sensor_msgs.msg import JointState  # noqa: E402
from std_msgs.msg import Int64  # noqa: E402
from std_srvs.srv import SetBool  # noqa: E402

from tactile_push.testing import observer as module  # noqa: E402
from tactile_push.testing.observer import Heard, Observer, field, seconds  # noqa: E402
from tactile_push.testing.processes import claim_domain  # noqa: E402


@pytest.fixture
def domain():
    """Return a ROS domain of the test's own."""
    domain, lock = claim_domain()
    yield domain
    lock.close()


@pytest.fixture
def observer(domain):
    with Observer(domain) as observer:
        yield observer


@pytest.fixture
def other(observer):
    """Return another node in the process, which works while the observer waits."""
    node = Node('other')
    observer.add(node)
    return node


def test_heard_messages_have_the_time_at_which_they_arrived(monkeypatch):
    times = iter([1.0, 2.0, 2.5, 4.0])
    monkeypatch.setattr(module, 'time', SimpleNamespace(monotonic=lambda: next(times)))
    heard = Heard()
    for message in 'abcd':
        heard.append(message)
    assert heard == list('abcd')
    assert heard.times == [1.0, 2.0, 2.5, 4.0]
    assert heard.timed(2) == [(2.5, 'c'), (4.0, 'd')]
    assert heard.timed(-1) == [(4.0, 'd')]
    assert heard.since(2.0) == ['c', 'd']  # not what arrived at the very moment
    assert heard.since(4.0) == []


def test_position_is_found_by_its_name():
    message = JointState(name=['theta', 'd'], position=[0.5, -1.0])
    assert (field(message, 'd'), field(message, 'theta')) == (-1.0, 0.5)
    with pytest.raises(ValueError):
        field(message, 'c')


def test_stamp_is_in_seconds():
    message = JointState()
    message.header.stamp.sec, message.header.stamp.nanosec = 12, 250_000_000
    assert seconds(message) == 12.25


def test_messages_are_heard_in_their_order(observer, other):
    heard = observer.hear(Int64, '/number')
    publisher = other.create_publisher(Int64, '/number', 100)
    observer.wait_for(publisher.get_subscription_count, 'the observer to listen')
    for number in range(10):
        publisher.publish(Int64(data=number))
    observer.wait_for(lambda: len(heard) == 10, 'all messages')
    assert [message.data for message in heard] == list(range(10))
    assert heard.times == sorted(heard.times)


def test_waiting_returns_the_first_value_that_is_true(observer):
    values = iter([0, '', None, [], 'found', 'too late'])
    assert observer.wait_for(lambda: next(values), 'a value') == 'found'


def test_waiting_ends_with_what_was_waited_for(observer):
    with pytest.raises(TimeoutError, match=r'^waited 0\.05 s in vain for the moon$'):
        observer.wait_for(lambda: False, 'the moon', patience=0.05)


def test_service_that_nobody_offers_is_waited_for_so_long_and_named(observer):
    with pytest.raises(TimeoutError, match=r'waited 0\.05 s in vain for service /nobody$'):
        observer.call(SetBool, '/nobody', SetBool.Request(), patience=0.05)


def test_service_is_called_and_its_answer_returned(observer, other):
    def answer(request, response):
        response.success, response.message = not request.data, 'turned'
        return response

    other.create_service(SetBool, '/turn', answer)
    for data in (True, False):
        response = observer.call(SetBool, '/turn', SetBool.Request(data=data))
        assert (response.success, response.message) == (not data, 'turned')


@pytest.mark.parametrize('success', [True, False])
def test_managed_node_says_whether_it_made_the_transition(observer, other, success):
    asked = []

    def change(request, response):
        asked.append(request.transition.id)
        response.success = success
        return response

    other.create_service(ChangeState, '/managed/change_state', change)
    assert observer.change_state('/managed', Transition.TRANSITION_ACTIVATE) is success
    assert asked == [Transition.TRANSITION_ACTIVATE]


def test_node_answers_for_each_parameter_that_is_set(observer, other):
    def check(parameters):
        low = all(parameter.value < 1.0 for parameter in parameters)
        return SetParametersResult(successful=low, reason='' if low else 'too high')

    other.declare_parameter('kp', 0.1)
    other.declare_parameter('kd', 0.1)
    other.add_on_set_parameters_callback(check)
    results = observer.set_parameters('/other', kp=0.5, kd=5.0)
    assert [(result.successful, result.reason) for result in results] == [
        (True, ''),
        (False, 'too high'),
    ]
    assert (other.get_parameter('kp').value, other.get_parameter('kd').value) == (0.5, 0.1)


def test_node_of_another_context_is_refused(observer, domain):
    context = Context()
    rclpy.init(context=context, domain_id=domain)
    node = Node('stranger', context=context)
    with pytest.raises(ValueError, match='node stranger: expected a node made after the observer'):
        observer.add(node)
    node.destroy_node()
    rclpy.shutdown(context=context)


def test_default_context_is_free_again_afterwards(domain):
    with Observer(domain):
        assert get_default_context().ok()
        with Observer(domain, 'second') as second:  # in a context of its own
            assert second.node.context is not get_default_context()
        assert get_default_context().ok()
    assert not get_default_context().ok()
