# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import signal
import threading

import pytest

rclpy = pytest.importorskip('rclpy')

from rclpy.signals import SignalHandlerOptions  # noqa: E402

from tactile_push.nodes.ros.executor import Executor  # noqa: E402
from tactile_push.testing.processes import claim_domain  # noqa: E402


@pytest.fixture
def node():
    """Make a node in the process's own context, which the executor takes."""
    domain, lock = claim_domain()
    rclpy.init(domain_id=domain, signal_handler_options=SignalHandlerOptions.NO)
    node = rclpy.create_node('alone')
    yield node
    node.destroy_node()
    rclpy.shutdown()
    lock.close()


@pytest.fixture
def executor(node):
    executor = Executor()
    executor.add_node(node)
    yield executor
    executor.shutdown()


@pytest.fixture
def heard():
    """Collect the signals of one kind instead of dying of them."""
    numbers = []
    before = signal.signal(signal.SIGUSR1, lambda number, frame: numbers.append(number))
    yield numbers
    signal.signal(signal.SIGUSR1, before)


def test_signal_ends_the_wait(executor, heard):
    while not heard:  # without a timer the wait has no other end
        threading.Timer(0.2, signal.raise_signal, [signal.SIGUSR1]).start()
        executor.spin_once()


def test_what_a_callback_adds_is_looked_after(executor, node):
    done = []

    def first():
        timer.cancel()
        node.create_timer(0.01, lambda: done.append(True))

    timer = node.create_timer(0.01, first)
    while not done:
        executor.spin_once()


def test_another_thread_ends_the_wait(executor, node):
    guard = node.create_guard_condition(lambda: done.append(True))
    done: list[bool] = []
    threading.Timer(0.2, guard.trigger).start()
    while not done:
        executor.spin_once()


def test_after_the_end_signals_are_nobodys_business(node, heard):
    executor = Executor()
    assert executor.shutdown()
    signal.raise_signal(signal.SIGUSR1)
    assert heard == [signal.SIGUSR1]
    assert not any(thread.name == 'signals' for thread in threading.enumerate())
