# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
from support.finger_seen import WELL, faults
from tactile_push.doctor import MISSING, Snapshot, findings
from tactile_push.interface import CONTACT_GEOMETRY, PUSH_CONTROLLER, TACTILE


def test_nothing_is_wrong_with_a_finger_that_is_well():
    assert faults(WELL) == []
    found = findings(WELL)
    assert len(found) > 10
    assert all(finding.remedy == '' for finding in found)


def test_without_any_node_all_that_the_loop_needs_is_missing():
    found = findings(Snapshot(()))
    assert {finding.verdict for finding in found} == {MISSING}
    assert [finding.subject for finding in found] == [CONTACT_GEOMETRY, PUSH_CONTROLLER, TACTILE]
