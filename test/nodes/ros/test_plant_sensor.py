# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a plant's finger feels with: bytes of readings, and wrenches. The rig is `sim_plant`'s."""

import math

import pytest
from geometry_msgs.msg import PoseStamped, WrenchStamped
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState

from tactile_push.devices.device import Device
from tactile_push.devices.stream import SentenceStream
from tactile_push.interface import CLOCK, CONTACT, GEOMETRY_STATE, WRENCH
from tactile_push.nodes.sim_plant import SimPlant
from tactile_push.pipeline.stamps import stamp_of


@pytest.fixture
def plant(bench, tmp_path):
    """Return what starts the plant with a device of its own."""
    return lambda **parameters: bench.start(
        SimPlant, **{'device': tmp_path / 'sensor', 'sensor_rate': 100.0, **parameters}
    )


def test_force_torque_sensor_feels_the_finger_push(bench, plant):
    plant(publish_wrench=True, theta_initial=0.0, d_initial=0.0, f_max=2.0)
    bench.hear(WrenchStamped, WRENCH)
    bench.until(lambda: len(bench.heard[WRENCH]) > 3)
    first, *_, last = bench.heard[WRENCH]
    # The finger points ahead, so the object pushes it back along its pole.
    assert (last.wrench.force.x, last.wrench.force.z) == pytest.approx((0.0, -2.0), abs=1e-9)
    assert last.header.frame_id == 'force_sensor'
    assert stamp_of(first) < stamp_of(last)


def test_a_reading_is_sent_again_if_it_was_refused_and_not_while_it_may_be_late(
    bench, plant, monkeypatch
):
    monkeypatch.setattr('tactile_push.nodes.ros.plant_sensor.LOST', math.inf)
    node = plant(publish_clock=True)
    bench.hear(Clock, CLOCK)
    judged = bench.publisher(JointState, GEOMETRY_STATE)
    contacts, clocks = bench.publisher(PoseStamped, CONTACT), bench.heard[CLOCK]
    bench.until(lambda: clocks)
    contact = PoseStamped()
    contact.header.stamp = clocks[-1].clock
    contacts.publish(contact)
    bench.until(lambda: node._pace.contact_overdue)

    def wait():
        """Wait until the time that stands was published some times more."""
        seen = len(clocks)
        bench.until(lambda: len(clocks) > seen + 5)
        return node._sensor._sequence

    sent = wait()
    assert wait() == sent
    judged.publish(JointState(name=['refusal'], position=[1.0]))
    bench.until(lambda: node._sensor._sequence == sent + 1)
    judged.publish(JointState(name=['refusal'], position=[0.0]))  # its contact is on its way
    assert wait() == sent + 1
    contacts.publish(contact)  # stamped before the reading: the driver was late to hear the clock
    bench.until(lambda: node._sensor._sequence == sent + 2)


def test_readings_come_out_of_the_device(bench, plant, tmp_path):
    plant(theta_initial=0.2)
    device, stream, readings = Device(str(tmp_path / 'sensor'), 115200), SentenceStream(), []
    bench.until(lambda: len(readings) > 3, lambda: readings.extend(stream.feed(device.read())))
    device.close()
    # A finger that points straight ahead: the edge turned by theta is felt so far from the pole.
    assert {round(math.pi / 2.0 - reading.elevation, 4) for reading in readings} == {0.2}
    assert stream.lost == 0
