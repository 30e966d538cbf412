# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A finger of the rig that places objects by the steps of the nodes, and the bag of it."""

import json
import math

from support.bag_making import encode
from tactile_push.bags import BagWriter
from tactile_push.interface import PLACE_GOAL, PLACE_RELEASE, SENSING_STATE, TOPICS
from tactile_push.parameters import ContactGeometryParameters
from tactile_push.parameters.active_sensing import ActiveSensingParameters, make_sensing
from tactile_push.parameters.contact_geometry import make_finder
from tactile_push.parameters.push_controller import (
    PushControllerParameters,
    choose_law,
    make_control,
    make_finger,
)
from tactile_push.pipeline import Control, Geometry, Sensing, edge_angle
from tactile_push.pipeline.orientation import quaternion_of_yaw
from tactile_push.pipeline.stamps import epoch_of, seconds_since
from tactile_push.simulation import Rig, paper_block
from tactile_push.simulation.experiment import ANGLES, JOINTS
from tactile_push.simulation.faults import Faults
from tactile_push.simulation.sensor import Readout, Sensor
from tactile_push.simulation.servo import Servo

PERIOD = 100_000_000  # [ns]
BEGIN = 1_795_000_000 * 10**9  # some day in 2026 [ns]
NOISE, LAG = math.radians(0.2), 0.1
CONTROLLER = {'law': 'place', 'finger_lag': LAG, 'joint_names': list(JOINTS)}
SENSING = {'edge': 0, 'noise': NOISE, 'finger_lag': LAG, 'l_share': 0.01, 'tilt_max': 0.0}
EPOCH = epoch_of(BEGIN // 10**9)


def seconds(sec, nanosec):
    return seconds_since(EPOCH, sec, nanosec)


class Line:
    """A belt that brings one object after the other to a finger which places them.

    The finger lifts when it is told to, and is put down beside the next object, which begins where
    the first one did. `heard` has topic, log time [ns] and fields of each message. Estimates come
    `late` control periods later than they could, and readings are `age` old at a tick [s].
    """

    def __init__(self, theta=0.2, d=0.003, late=0, age=0.0, **controller):
        self.parameters = CONTROLLER | controller
        p = PushControllerParameters.of(self.parameters)
        self.control = Control(make_control(p), make_finger(p), p.joint_names, seconds)
        choose_law(self.control, p, seconds)
        self.placing = self.control.placing
        self.sensing = Sensing(make_sensing(ActiveSensingParameters.of(SENSING)), seconds)
        self.geometry = Geometry(make_finder(ContactGeometryParameters()), JOINTS, seconds)
        self.config = paper_block(theta=theta, d=d)
        self.rig = Rig(self.config, Faults(servo=Servo(time_constant=LAG)))
        self.joints_tell = True
        self.home = self.centre  # where each object begins [m]
        self.readout = Readout(Sensor(NOISE), 0)
        self.now, self.age, self.late = BEGIN, age, late
        self.ticks, self.states, self.heard, self.placed = [], [], [], []
        self.feels = self.senses = True
        self._under_way = []
        self._said = 0  # in this period
        self._tick = None  # the last one
        self._free_in = math.nan  # [s]
        self.before_release = lambda line: None
        self.control.push.activate(seconds(*self.stamp))

    @property
    def stamp(self):
        return divmod(self.now, 10**9)

    @property
    def centre(self):
        """Where the centre of mass is across the belt [m]."""
        return self.rig.object_in_finger_disk.x + self.rig.finger_pose.x

    def ask(self, x, theta, frame='finger_base'):
        """Publish a goal aside of where the objects begin; return why it is refused."""
        z, w = quaternion_of_yaw(theta)
        pose = {'position': {'x': self.home + x}, 'orientation': {'z': z, 'w': w}}
        self._hear(PLACE_GOAL, {'header': {'frame_id': frame}, 'pose': pose})
        return self.placing.goal(frame, self.home + x, (0.0, 0.0, z, w))

    def period(self):
        """Let a control period pass, and return the tick."""
        self._said = 0
        self._feel()
        self._advance(self.age)
        if len(self._under_way) > self.late:
            for topic, message in self._under_way.pop(0):
                self._hear(topic, message)
                if topic == SENSING_STATE:
                    stamp = message['header']['stamp']
                    at = stamp['sec'], stamp['nanosec']
                    self.placing.sensed(at, message['name'], message['position'])
        tick = self.control.tick(self.stamp, 0.1 if self.ticks else math.nan)
        for topic, fields in self.control.outputs(self.stamp, tick):
            self._hear(topic, fields)
            if topic == PLACE_RELEASE:
                self._put_down()
        self.ticks.append(tick)
        self.states.append(self.placing.values())
        self.placing.look_ahead()
        if self.senses:
            self._under_way.append([*self.sensing.tick(self.stamp, tick).outputs()])
        self._tick, self._free_in = tick, self.placing.let_go_in
        self._advance(PERIOD * 1e-9 - self.age)
        self.now += PERIOD
        return tick

    def until(self, condition, periods=900):
        """Let control periods pass until a condition holds."""
        for _ in range(periods):
            self.period()
            if condition():
                return
        raise AssertionError(f'in vain for {periods} periods: {self.placing.stage}')

    def deactivate(self):
        """Rest, as the node does when it is deactivated."""
        self._said = 0
        tick = self.control.deactivate()
        for topic, fields in self.control.outputs(self.stamp, tick):
            self._hear(topic, fields)
        self.states.append(self.placing.values())

    def bag(self, folder):
        """Write what was heard into a bag."""
        with BagWriter(folder) as writer:
            for topic in dict.fromkeys(topic for topic, _, _ in self.heard):
                writer.add_topic(f'/{topic}', TOPICS[topic].type_name)
            for topic, log_time, fields in self.heard:
                data = encode(TOPICS[topic].type_name, **fields)
                writer.write(f'/{topic}', data, log_time, log_time)
            notes = {'push_controller': self.parameters, 'active_sensing': SENSING}
            writer.note('tactile_push.parameters', json.dumps(notes))
        return folder

    def _hear(self, topic, fields):
        # In the order in which it happens, a microsecond apart.
        self._said += 1
        self.heard.append((topic, self.now + 1000 * self._said, fields))

    def _feel(self):
        """Read joints and sensor, and pass on what they say."""
        stamp = divmod(self.now - round(1e9 * self.age), 10**9)
        joints = self.rig.joints
        self.geometry.joint_states(stamp, JOINTS, joints)
        if self.joints_tell:
            self.control.joint_states(stamp, JOINTS, joints)
        for sample in self.readout.read(self.rig.reading(), seconds(*stamp)) if self.feels else ():
            angles = sample.reading.azimuth, sample.reading.elevation
            felt = self.geometry.tactile(stamp, ANGLES, angles)
            for topic, fields in felt.outputs():
                self._hear(topic, fields)
            if felt.contact is not None:  # which is heard as a message
                theta = edge_angle('', 0.0, 0.0, *quaternion_of_yaw(felt.contact.theta))
                self.control.contact(stamp, theta)

    def _advance(self, duration):
        """Move the rig, and let go on the way if it is time."""
        if self._free_in <= duration:
            self._step(self._free_in)
            duration -= self._free_in
            self.before_release(self)
            if self.placing.release():
                self._hear(PLACE_RELEASE, {'data': True})
                self.placed.append((self.centre - self.home, self.rig.theta))
                self.rig.lift()
                self.feels = False
            self._free_in = math.nan
        self._free_in -= duration
        self._step(duration)

    def _step(self, duration):
        tick = self._tick
        if duration > 0.0 and tick is not None:
            self.rig.step(tick.v_x or 0.0, duration, tick.v_x is not None, tick.v_y)

    def _put_down(self):
        """Bring the next object, if the finger was up."""
        if not self.feels:
            self.rig = Rig(self.config, self.rig.faults)
            self.feels = True
