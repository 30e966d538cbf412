# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a recording notes in its bag beside the messages."""

import json
import time
from importlib.metadata import version

import pytest

rclpy = pytest.importorskip('rclpy')

from rclpy.context import Context  # noqa: E402
from rclpy.executors import SingleThreadedExecutor  # noqa: E402

from tactile_push.bags import BagReader, BagWriter  # noqa: E402
from tactile_push.interface import CONTACT_GEOMETRY, PARAMETERS_NOTE, VERSION_NOTE  # noqa: E402
from tactile_push.recording.recording import Recording  # noqa: E402
from tactile_push.testing.processes import claim_domain  # noqa: E402


@pytest.fixture
def make_node():
    """Return a function that makes a node; the executor that spins all of them is its attribute."""
    context = Context()
    domain, lock = claim_domain()
    rclpy.init(context=context, domain_id=domain)
    executor = SingleThreadedExecutor(context=context)

    def make(name):
        node = rclpy.create_node(name, context=context)
        executor.add_node(node)
        return node

    make.executor = executor
    yield make
    nodes = executor.get_nodes()
    executor.shutdown()
    for node in nodes:
        node.destroy_node()
    rclpy.shutdown(context=context)
    lock.close()


def test_version_and_parameters_are_noted(make_node, tmp_path):
    make_node(CONTACT_GEOMETRY).declare_parameter('radius', float('inf'))
    writer = BagWriter(tmp_path / 'bag')
    noted = []
    note = writer.note
    writer.note = lambda key, text: (noted.append(key), note(key, text))
    recording = Recording(make_node('recorder'), ['tactile'], writer)
    deadline = time.monotonic() + 60
    while PARAMETERS_NOTE not in noted:
        assert time.monotonic() < deadline
        make_node.executor.spin_once(timeout_sec=0.02)
    recording.close()
    with BagReader(tmp_path / 'bag') as reader:
        assert reader.notes[VERSION_NOTE] == version('tactile_push')
        parameters = json.loads(reader.notes[PARAMETERS_NOTE])
    assert parameters[CONTACT_GEOMETRY]['radius'] == float('inf')
