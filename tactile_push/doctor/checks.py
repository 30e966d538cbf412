# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Everything that the doctor asks about a running finger, in the order in which to mend it."""

from tactile_push.doctor.finding import Finding
from tactile_push.doctor.graph import (
    finger_is_moved,
    inputs_have_a_giver,
    managed_nodes_are_active,
    nodes_answer,
    nodes_run,
    one_publishes,
    qualities_match,
)
from tactile_push.doctor.messages import (
    clocks_agree,
    joints_are_there,
    messages_are_in_order,
    messages_come,
    nodes_are_well,
    parameters_agree,
)
from tactile_push.doctor.noise import gains_bear_the_noise
from tactile_push.doctor.snapshot import Snapshot

CHECKS = (
    nodes_run,
    nodes_answer,
    managed_nodes_are_active,
    inputs_have_a_giver,
    qualities_match,
    one_publishes,
    finger_is_moved,
    clocks_agree,
    messages_come,
    messages_are_in_order,
    joints_are_there,
    parameters_agree,
    gains_bear_the_noise,
    nodes_are_well,
)


def findings(seen: Snapshot) -> list[Finding]:
    """Answer every question about a running finger.

    Parameters
    ----------
    seen : Snapshot
        What was seen of it.

    Returns
    -------
    list of Finding
        In the order in which to mend what is wrong: later findings may follow from earlier ones.
    """
    return [finding for check in CHECKS for finding in check(seen)]
