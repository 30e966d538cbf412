# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a node is given by a parameter file."""

import contextlib

import rclpy
from rclpy.context import Context

from tactile_push.testing.processes import claim_domain


@contextlib.contextmanager
def private_context():
    """Yield a context in a ROS domain of its own."""
    context = Context()
    domain, lock = claim_domain()
    rclpy.init(context=context, domain_id=domain)
    yield context
    rclpy.shutdown(context=context)
    lock.close()


def node_with(context, file, node, namespace=''):
    """Return a node that was started with a parameter file; RuntimeError if rcl refuses it."""
    return rclpy.create_node(
        node,
        context=context,
        namespace=namespace,
        cli_args=['--ros-args', '--params-file', str(file)],
        use_global_arguments=False,
        enable_rosout=False,
        start_parameter_services=False,
    )


def given_to(node):
    """Return the values by name, read by rcl; it has none for an empty list."""
    given = {name: given.value for name, given in node._parameter_overrides.items()}
    return {name: [] if value is None else value for name, value in given.items()}
