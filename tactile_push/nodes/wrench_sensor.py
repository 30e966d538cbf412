# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Finds the contact on a hemispherical tip that sits on a force/torque sensor."""

import sys

from geometry_msgs.msg import WrenchStamped
from rclpy.lifecycle import LifecycleState, TransitionCallbackReturn

from tactile_push.interface import TARE, WRENCH, WRENCH_SENSOR
from tactile_push.nodes.ros.parameters import declare, refusing
from tactile_push.nodes.ros.process import run
from tactile_push.nodes.ros.qos import SENSOR_DATA
from tactile_push.nodes.ros.tip_sensor import TipSensor
from tactile_push.parameters.wrench_sensor import WrenchSensorParameters, wrench_sensing
from tactile_push.pipeline.stamps import stamp_of
from tactile_push.pipeline.wrenches import Touched, Wrenches
from tactile_push.tactile import Touch, WrenchReader
from tactile_push.tactile.wrench_reader import ANOTHER_FRAME, BEHIND, GAP, NOT_TARED, TORSION

DRIFTED = 0.5  # share of release_force that a tare may leave in the air; picked


class WrenchSensor(TipSensor[WrenchSensorParameters]):
    """Managed node: `wrench` in, `tactile` out.

    A tare tells the untouched tip. The node also warns when it has drifted.
    """

    NAME = WRENCH_SENSOR
    MESSAGES = 'wrenches'
    SERVICE = TARE
    TAKEN, NOT_TAKEN = 'tared', 'not tared'
    _topic = WRENCH
    _told: Touch | None

    def __init__(self) -> None:
        super().__init__()
        self._settings = declare(
            self, WrenchSensorParameters, self._take_parameters, wrench_sensing
        )
        with refusing():
            self._sensing = wrench_sensing(self._settings)
        self._forget_untouched()
        self._begin()

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Start to listen; the tare stays."""
        self._wrenches.reader.restart()
        return super().on_activate(state)

    def _forget_untouched(self) -> None:
        reader = WrenchReader(self._sensing, self._settings.needs_tare)
        self._wrenches = Wrenches(reader, self._time.seconds)

    def _take_parameters(self, settings: WrenchSensorParameters) -> None:
        self._settings = settings
        self._sensing = self._wrenches.reader.sensing = wrench_sensing(settings)

    def _subscribe(self) -> None:
        self.make_subscription(WrenchStamped, WRENCH, self._on_message, SENSOR_DATA)

    def _came_of(self, message: WrenchStamped) -> Touched:
        force, moment = message.wrench.force, message.wrench.torque
        return self._wrenches.wrench(
            *(stamp_of(message), message.header.frame_id),
            *((force.x, force.y, force.z), (moment.x, moment.y, moment.z)),
        )

    def _take_untouched(self) -> None:
        self._wrenches.reader.tare()

    def _ignorance(self) -> str:
        tared = self._wrenches.reader.tared or self._refusal not in ('', NOT_TARED)
        return '' if tared else 'not tared'

    def _values(self) -> dict[str, object]:
        reader, touch = self._wrenches.reader, self._told
        values: dict[str, object] = {
            'tared': reader.tared,
            'force [N]': f'{reader.force:.3f}',
            'force left in the air [N]': f'{reader.drift:.3f}',
        }
        if touch is not None and touch.reading.in_contact:
            values['normal force [N]'] = f'{touch.reading.normal_force:.3f}'
            values['tangential force [N]'] = f'{touch.tangential_force:.3f}'
            values['torsion [N m]'] = f'{touch.torsion:.5f}'
        return values

    def _doubt(self) -> str:
        drift = self._wrenches.reader.drift
        if drift > DRIFTED * self._settings.release_force:
            return f'tare drifts: {drift:.2f} N in the air; call {TARE}'
        return ''

    def _advice(self) -> str:
        return {
            GAP: f' by {self._wrenches.reader.gap:.3f} s, more than max_gap',
            TORSION: '; a contact beside the tip, two contacts, or a wrong tip_xyz or tip_radius',
            BEHIND: '; check the sign of the wrench (reaction) and tip_rpy',
            ANOTHER_FRAME: f' than {self._settings.calibrated_frame or "that of the tare"}',
        }.get(self._refusal, '')


def main() -> int:
    """Run the node as a process."""
    return run(WrenchSensor)


if __name__ == '__main__':
    sys.exit(main())
