# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Finds the contact on a hemispherical tip that sits on a force/torque sensor."""

import sys
import time
from collections import Counter

from geometry_msgs.msg import WrenchStamped
from rclpy.lifecycle import LifecycleState, TransitionCallbackReturn
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger

from tactile_push.interface import TACTILE, TARE, WRENCH, WRENCH_SENSOR
from tactile_push.nodes.ros.diagnostics import ERROR, OK, WARN, Diagnostics, Health
from tactile_push.nodes.ros.managed import ManagedNode
from tactile_push.nodes.ros.messages import filled
from tactile_push.nodes.ros.node_time import NodeTime
from tactile_push.nodes.ros.parameters import declare, refusing
from tactile_push.nodes.ros.process import run
from tactile_push.nodes.ros.qos import PUBLISHED, SENSOR_DATA
from tactile_push.parameters.wrench_sensor import WrenchSensorParameters, wrench_sensing
from tactile_push.pipeline.stamps import stamp_of
from tactile_push.pipeline.wrenches import Touched, Wrenches
from tactile_push.tactile import TareRefusedError, Touch, WrenchReader
from tactile_push.tactile.wrench_reader import ANOTHER_FRAME, BEHIND, GAP, NOT_TARED, TORSION

PATIENCE = 0.3  # of refused wrenches alone until it is an error [s]: the finger has stopped by then
DRIFTED = 0.5  # share of release_force that a tare may leave in the air; picked


class WrenchSensor(ManagedNode):
    """Managed node: `wrench` in, `tactile` out.

    The node reports an error when no wrench came for `silence_timeout`, while it is not tared, and
    when it refused all wrenches for `PATIENCE`. It warns while it refuses some, and when the tare
    has drifted.
    """

    NAME = WRENCH_SENSOR

    def __init__(self) -> None:
        super().__init__(self.NAME)
        self._settings = declare(
            self, WrenchSensorParameters, self._take_parameters, wrench_sensing
        )
        with refusing():
            self._sensing = wrench_sensing(self._settings)
        self._time = NodeTime(self)
        self._is_active = False
        self._counted: Counter[str] = Counter(wrenches=0, readings=0)
        self._make_reader()
        self.create_service(Trigger, TARE, self._on_tare)
        self._diagnostics = Diagnostics(self, self._health, lambda: self._counted)
        if self._settings.autostart:
            self.autostart()

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Create the topics, and forget the tare."""
        self._make_reader()
        self._publisher = self.create_lifecycle_publisher(JointState, TACTILE, PUBLISHED)
        self._subscription = self.create_subscription(
            WrenchStamped, WRENCH, self._on_wrench, SENSOR_DATA
        )
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Start to listen."""
        result = super().on_activate(state)
        self._wrenches.reader.restart()
        self._heard = self._useful = time.monotonic()
        self._is_active = True
        return result

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Stop to listen."""
        self._is_active = False
        return super().on_deactivate(state)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Remove the topics."""
        self.destroy_lifecycle_publisher(self._publisher)
        self.destroy_subscription(self._subscription)
        return TransitionCallbackReturn.SUCCESS

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Stop to listen for good."""
        self._is_active = False
        return TransitionCallbackReturn.SUCCESS

    def _make_reader(self) -> None:
        reader = WrenchReader(self._sensing, self._settings.needs_tare)
        self._wrenches = Wrenches(reader, self._time.seconds)
        # When the last wrench came, and the last useful one, by a clock that cannot be set [s].
        self._heard = self._useful = time.monotonic()
        self._refusal = ''  # why the last refused wrench was refused
        self._touch: Touch | None = None  # of the last reading

    def _take_parameters(self, settings: WrenchSensorParameters) -> None:
        self._settings = settings
        self._sensing = self._wrenches.reader.sensing = wrench_sensing(settings)

    def _on_wrench(self, message: WrenchStamped) -> None:
        if not self._is_active:
            return
        self._counted['wrenches'] += 1
        now = time.monotonic()
        if now - self._heard > PATIENCE:
            self._useful = now  # after a silence patience starts over
        self._heard = now
        force, moment = message.wrench.force, message.wrench.torque
        touched = self._wrenches.wrench(
            *(stamp_of(message), message.header.frame_id),
            *((force.x, force.y, force.z), (moment.x, moment.y, moment.z)),
        )
        self._note(touched, now)
        for _, fields in touched.outputs():
            self._counted['readings'] += 1
            self._publisher.publish(filled(JointState(), fields))

    def _note(self, touched: Touched, now: float) -> None:
        if touched.refusal:
            self._counted[f'refused: {touched.refusal}'] += 1
            self._refusal = touched.refusal
            return
        self._useful = now
        if touched.touch is not None:
            self._touch = touched.touch

    def _on_tare(self, request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        reader = self._wrenches.reader
        try:
            if not self._is_active:
                raise TareRefusedError('the node is not active')
            if time.monotonic() - self._heard > self._settings.silence_timeout:
                raise TareRefusedError(f'no wrenches on {WRENCH}')
            reader.tare()
        except TareRefusedError as reason:
            response.success, response.message = False, str(reason)
            self.get_logger().warning(f'not tared: {reason}')
        else:
            response.success, response.message = True, ''
            self.get_logger().info('tared')
        return response

    def _health(self) -> Health:
        reader, touch = self._wrenches.reader, self._touch
        values: dict[str, object] = {
            'tared': reader.tared,
            'force [N]': f'{reader.force:.3f}',
            'force left in the air [N]': f'{reader.drift:.3f}',
        }
        if touch is not None and touch.reading.in_contact:
            values['normal force [N]'] = f'{touch.reading.normal_force:.3f}'
            values['tangential force [N]'] = f'{touch.tangential_force:.3f}'
            values['torsion [N m]'] = f'{touch.torsion:.5f}'
        level, message = self._judgement()
        return Health(level, message, values)

    def _judgement(self) -> tuple[bytes, str]:
        p, reader, now = self._settings, self._wrenches.reader, time.monotonic()
        if not self._is_active:
            return OK, 'inactive'
        if now - self._heard > p.silence_timeout:
            return ERROR, f'no wrenches on {WRENCH}'
        if not reader.tared and self._refusal in ('', NOT_TARED):
            return ERROR, f'not tared: lift the finger and call {TARE}'
        if now - self._useful > PATIENCE:
            return ERROR, f'wrenches refused: {self._refusal}{self._advice()}'
        if reader.drift > DRIFTED * p.release_force:
            return WARN, f'tare drifts: {reader.drift:.2f} N in the air; call {TARE}'
        if self._touch is None:
            return WARN, 'no reading yet'
        feels = 'contact' if self._touch.reading.in_contact else 'no contact'
        rates = self._diagnostics.rates
        if any(rate for name, rate in rates.items() if name.startswith('refused: ')):
            return WARN, f'{feels}, some wrenches refused'
        return OK, feels

    def _advice(self) -> str:
        """Return what to look at when all wrenches are refused for the last reason."""
        reader = self._wrenches.reader
        return {
            GAP: f' by {reader.gap:.3f} s, more than max_gap',
            TORSION: '; a contact beside the tip, two contacts, or a wrong tip_xyz or tip_radius',
            BEHIND: '; check the sign of the wrench (reaction) and tip_rpy',
            ANOTHER_FRAME: ' than that of the tare',
        }.get(self._refusal, '')


def main() -> int:
    """Run the node as a process."""
    return run(WrenchSensor)


if __name__ == '__main__':
    sys.exit(main())
