# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The rig in MuJoCo: independent physics with a finger of joints and a push above the belt.

This module needs the package mujoco; of the room only `mujoco_joint_rig` imports it.
"""

import math
from collections.abc import Callable

import mujoco
import numpy as np

from tactile_push.interface import POINTS
from tactile_push.mechanics import (
    CONTACT,
    FREE,
    MODES,
    POLE,
    SLIP_LEFT,
    SLIP_RIGHT,
    STICK,
    Pose,
    clearance,
)
from tactile_push.mechanics.compiled import Array
from tactile_push.simulation.faults import NO_FAULTS, Faults
from tactile_push.simulation.lift import Lift
from tactile_push.simulation.mujoco_model import (
    GRAVITY,
    MOST_FRICTION,
    SAG,
    TIME_STEP,
    MujocoPhysics,
    model_xml,
)
from tactile_push.simulation.rig import Rig, RigConfig, directions
from tactile_push.simulation.servo import DelayLine, quantised
from tactile_push.tactile import (
    NO_CONTACT,
    FingerPose,
    OutOfReachError,
    Reading,
    reading_of_contact,
)
from tactile_push.tactile.hemisphere import normalized_angle
from tactile_push.tactile.planar_finger import pole_angle

SETTLING = 0.2  # for the feet to take the weight [s]: five times as long as they swing
RETREAT = 0.01  # of the tip meanwhile [m]
OVERHEAD = 0.01  # between object and lifted tip [m]
LOOSE = 0.2  # share of the friction on the belt that a finger in contact feels at least; picked
FIRST_DENT = 1e-6  # with which finger and object touch at the start [m]
HOLD = 5.0  # rate at which the finger goes back to its line across the belt [1/s]; picked
REACH = 1e-4  # the finger stays so far from the end of its reach [m], where joints would race
SLOW = 0.01  # share of the belt's speed that counts as rest; a contact that sticks creeps slower

# Where things stand in MuJoCo's qpos, and the links' rates in its qvel. A free body has 7 and 6.
BASE, LINKS, WRIST, LINKS_AND_WRIST = 7, slice(8, 10), 10, slice(8, 11)
BASE_RATE, LINK_RATES = 6, slice(7, 9)


class MujocoRig(Lift):
    """The rig in motion, as `Rig` is, but by MuJoCo.

    Everything that is told of the object, the contact and the finger is what MuJoCo has.

    Parameters
    ----------
    config : RigConfig
        What the rig is made of and where it starts. Infinite friction is one of 1000.
    physics : MujocoPhysics
        What else MuJoCo has to know.
    faults : Faults, optional
        How far it is from a perfect one; its sensor is left to whoever reads. They may be replaced
        at any time.
    """

    def __init__(
        self, config: RigConfig, physics: MujocoPhysics, faults: Faults = NO_FAULTS
    ) -> None:
        super().__init__()
        self.config = config
        self.physics = physics
        self.faults = faults
        self._model = mujoco.MjModel.from_xml_string(model_xml(config, physics))
        self._data = mujoco.MjData(self._model)
        self._object, self._tip = (self._model.body(name).id for name in ('object', 'tip'))
        self._touch = [self._model.geom(name).id for name in ('tip', 'side')]
        links = config.finger
        # The knuckle points across the belt, the pole along it.
        self._home = links.forward(math.pi - links.mount_angle, -math.pi / 2.0)
        self._commands: DelayLine[tuple[float, ...]] = DelayLine((0.0, 0.0))
        self._wanted = 0.0, 0.0  # velocities that the servos are asked for now [m/s]
        self._line = self._home.y  # on which they hold the disk's centre [m]
        self.time = 0.0  #: how long it has been in motion [s]
        self.v_y = 0.0  #: the belt's speed at the end of the last step [m/s]
        self.touching = True  #: whether finger and object touch
        #: angle of the tangent plane at the last contact [rad], which turns with a released object
        self.theta = config.theta
        #: what the finger exerts on the object, x and y in `finger_base` [N]
        self.contact_force = (0.0, 0.0)
        self.normal_force = 0.0  #: its part along the normal [N]
        self.mode = FREE  #: how the contact moved at the end of the last step, an index of `MODES`
        self.phi = math.pi / 2.0  #: direction of the finger on the belt [rad]
        self.at_workspace_limit = False  #: whether the finger could not follow its velocity
        self._edge = 0.0  # angle of a released object's edge in the object [rad]
        self._settle()
        # How an object lies that is touched as configured, from where the finger is.
        self._laid = self._data.qpos[:BASE].copy()
        self._laid[:2] -= self.finger_x, self.finger_y

    def _settle(self) -> None:
        """Let the object settle on its feet, and touch it."""
        finger, q = self.config.finger, self._data.qpos
        pose = Rig(self.config).object_pose
        q[:3] = self._home.x + pose.x, self._home.y + pose.y, -SAG
        q[3], q[6] = math.cos(pose.angle / 2.0), math.sin(pose.angle / 2.0)
        q[BASE] = -RETREAT
        q[LINKS] = finger.inverse(self._home.x, self._home.y)
        if not self.config.tip_turns:
            q[WRIST] = math.pi / 2.0 - pole_angle(finger.mount_angle, q[LINKS])
        self._simulate(self._towards(0.0, 0.0), SETTLING, belt_running=False)
        q[BASE] = FIRST_DENT / math.cos(self.config.theta)
        self._data.qvel[:] = 0.0
        mujoco.mj_forward(self._model, self._data)
        self.time = 0.0
        self._look()

    def _come_off(self) -> None:
        self._look()  # at the angle of the edge now
        self.lifted = True
        physics = self.physics
        height = physics.object_height - physics.push_height + self.config.radius + OVERHEAD
        self._model.body_pos[self._tip, 2] = height
        self._edge = self.theta - self.object_pose.angle
        mujoco.mj_forward(self._model, self._data)
        self._look()

    def _touch_next(self) -> None:
        self._model.body_pos[self._tip, 2] = 0.0
        finger = self.finger_x, self.finger_y
        self._data.qpos[:BASE] = self._laid
        self._data.qpos[:2] += finger
        self._data.qvel[:BASE_RATE] = 0.0
        mujoco.mj_forward(self._model, self._data)
        self._look()

    @property
    def is_loose(self) -> bool:
        """Whether the object presses less on the finger than one that the belt has carried there.

        It is put down beside the finger, and while the belt stands it creeps away, as MuJoCo's
        friction is viscous: after a minute a twentieth of the force is left.
        """
        weight = self.physics.mass * GRAVITY
        force = math.hypot(*self.contact_force)
        return self.touching and force < LOOSE * self.physics.mu_s * weight

    @property
    def finger_x(self) -> float:
        """Centre of the finger's disk on the belt, from its start [m]."""
        return self._links.x - self._home.x

    @property
    def finger_y(self) -> float:
        """The same along the belt, where the finger moves at +v_y [m]."""
        return float(self._data.qpos[BASE]) + self.along

    @property
    def along(self) -> float:
        """How far it is along the belt from its line at the start [m]."""
        return self._links.y - self._home.y

    @property
    def belt_travel(self) -> float:
        """How far the belt has moved [m]."""
        return float(self._data.qpos[BASE])

    @property
    def v_x(self) -> float:
        """Velocity across the belt of the point of the finger that follows commands [m/s]."""
        proximal, distal = self._data.qvel[LINK_RATES].tolist()
        (_, y), (_, distal_y) = self._levers
        return -y * proximal - distal_y * distal

    @property
    def object_pose(self) -> Pose:
        """Centre of mass and orientation of the object on the belt."""
        x, y, _ = self._data.xipos[self._object].tolist()
        turn = self._data.xmat[self._object]
        return Pose(x - self._home.x, y - self._home.y, math.atan2(turn[3], turn[0]))

    @property
    def d(self) -> float:
        """The paper's d of the contact [m]."""
        place = self.object_in_finger_disk
        return -place.x * math.cos(self.theta) - place.y * math.sin(self.theta)

    @property
    def gap(self) -> float:
        """Distance between finger and object [m]; negative by the tip's dent."""
        return clearance(*self._around)[1]

    @property
    def sigma(self) -> float:
        """Position of the disk along its path around the object [m]."""
        return float(clearance(*self._around)[0])

    @property
    def mode_name(self) -> str:
        """The contact's mode as a word."""
        return MODES[self.mode]

    @property
    def joints(self) -> tuple[float, ...]:
        """Angles of the finger's two moving joints and, if it has one, of the wrist [rad]."""
        return tuple(self._data.qpos[LINKS if self.config.tip_turns else LINKS_AND_WRIST].tolist())

    @property
    def psi(self) -> float:
        """Angle of the finger tip's pole in `finger_base` [rad]."""
        return pole_angle(self.config.finger.mount_angle, self.joints)

    @property
    def finger_pose(self) -> FingerPose:
        """Pose of the finger tip in `finger_base`."""
        links = self._links
        return FingerPose(links.x, links.y, self.psi)

    @property
    def _links(self) -> FingerPose:
        """Where the links alone, without a wrist, bring and point the disk."""
        return self.config.finger.forward(*self._data.qpos[LINKS].tolist())

    @property
    def _levers(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """What the point that follows commands has from each joint, x and y as its rates [m]."""
        links, b = self._links, self.config.finger.distal_length
        x, y = b * math.cos(links.psi), b * math.sin(links.psi)
        beyond = 0.0  # the centre of a tip that turns
        if self.config.tip_turns and self.config.commanded_point == POINTS[POLE]:
            beyond = self.config.radius * math.sin(links.psi)
        elif self.config.tip_turns and self.config.commanded_point == POINTS[CONTACT]:
            beyond = self.config.radius * math.cos(self.theta)
        return (links.x, links.y + beyond), (x, y + beyond)

    @property
    def object_in_finger_disk(self) -> Pose:
        """Pose of the object in the frame `finger_disk`."""
        pose = self.object_pose
        return Pose(pose.x - self.finger_x, pose.y - self.finger_y, pose.angle)

    @property
    def contact_directions(self) -> dict[str, tuple[float, float]]:
        """Unit vectors at the contact: 'normal', 'left' and 'right' (friction cone), 'push'."""
        alpha = math.atan(self._model.pair_friction[0, 0])
        return directions(self.theta, alpha, self.phi)

    def reading(self) -> Reading:
        """Read the sensor.

        Returns
        -------
        Reading
            Azimuth and elevation [rad], and normal force [N]; NaN without contact or behind the
            hemisphere.
        """
        if not self.touching:
            return NO_CONTACT
        return reading_of_contact(self.theta, self.psi, self.normal_force) or NO_CONTACT

    def step(
        self, v_x: float, duration: float, belt_running: bool = True, v_along: float = 0.0
    ) -> None:
        """Let the finger and the belt move for a while.

        Parameters
        ----------
        v_x : float
            Velocity of the finger across the belt [m/s], as commanded.
        duration : float
            How long [s].
        belt_running : bool, optional
            Whether the belt moves.
        v_along : float, optional
            Velocity of the finger along the belt, against its motion [m/s], as commanded.
        """
        self.at_workspace_limit = False
        servo = self.faults.servo
        commands = v_x, v_along
        for arrived, length in self._commands.arriving(commands, self.time, duration, servo.delay):
            command = (quantised(one, servo.velocity_quantum) for one in arrived)
            self._simulate(self._towards(*command), length, belt_running)
        self._look()

    def _towards(self, across: float, along: float) -> Callable[[float], tuple[float, ...]]:
        """Return what asks the servos, a step [s] after the other, for velocities [m/s]."""

        def ask(step: float) -> tuple[float, ...]:
            behind, (v_x, v_along) = self._behind(step), self._wanted
            v_x, v_along = across + behind * (v_x - across), along + behind * (v_along - along)
            self._wanted = v_x, v_along = self._within_limits(v_x, v_along, step)
            self._line += v_along * step
            return self._joint_velocities(v_x, v_along)

        return ask

    def _behind(self, step: float) -> float:
        """Return the share of a velocity's error that the servos' lag leaves after a step [s]."""
        lag = self.faults.servo.time_constant
        return math.exp(-step / lag) if lag > 0.0 else 0.0

    def _simulate(
        self, ask: Callable[[float], tuple[float, ...]], duration: float, belt_running: bool
    ) -> None:
        """Let the servos do what they are asked for in each step [s]."""
        steps = math.ceil(duration / TIME_STEP - 1e-6)
        if steps <= 0:
            return
        self._model.opt.timestep = step = duration / steps
        data, belt = self._data, self.faults.belt
        for _ in range(steps):
            wanted = ask(step)
            if self.faults.friction.ripple > 0.0:
                self._make_friction_uneven()
            data.ctrl[:] = wanted
            self.v_y = 0.0
            if belt_running:
                self.v_y = belt.mean_speed(self.config.belt_speed, self.time, step)
            data.qvel[BASE_RATE] = self.v_y
            mujoco.mj_step(self._model, data)
            self.time += step
            self._go_on_lifting(step)

    def _within_limits(self, v_x: float, v_along: float, step: float) -> tuple[float, float]:
        """Return the velocities, or 0 where the finger can go no further."""
        x, line = self._links.x, self._line + v_along * step
        inside = self.faults.workspace.time_inside(x, v_x, step) == step
        try:
            self.config.finger.inverse(x + math.copysign(REACH, v_x), line)
        except OutOfReachError:
            inside = False
        if inside or v_x == v_along == 0.0:
            return v_x, v_along
        self.at_workspace_limit = True
        return 0.0, 0.0

    def _joint_velocities(self, v_x: float, v_along: float) -> tuple[float, ...]:
        """Return what moves the point across the belt, and keeps the disk's centre on its line."""
        (x, y), (distal_x, distal_y) = self._levers
        v_y = v_along + HOLD * (self._line - self._links.y)
        det = distal_y * x - y * distal_x
        links = (v_x * distal_x + v_y * distal_y) / det, -(v_x * x + v_y * y) / det
        return self._with_wrist(links)

    def _with_wrist(self, links: tuple[float, ...]) -> tuple[float, ...]:
        """Return the velocities of the links, and of the wrist that holds the tip straight."""
        if self.config.tip_turns:
            return links
        return *links, HOLD * (math.pi / 2.0 - self.psi) - sum(links)

    def _look(self) -> None:
        """Take the contact from MuJoCo's list."""
        data = self._data
        v_x = self.v_x
        v_y = self.v_y + self._wanted[1]
        if v_y > 0.0 or abs(v_x) > self._slow:
            self.phi = math.atan2(v_y, v_x)
        found = np.flatnonzero((data.contact.geom == self._touch).all(axis=1))
        self.touching = len(found) > 0
        if not self.touching:
            self.mode, self.normal_force, self.contact_force = FREE, 0.0, (0.0, 0.0)
            if self.lifted:
                self.theta = self.object_pose.angle + self._edge
            return
        contact = data.contact[found[0]]
        normal, *along = contact.frame.reshape(3, 3)
        self.theta = normalized_angle(math.atan2(normal[1], normal[0]) - math.pi / 2.0)
        rows = slice(contact.efc_address, contact.efc_address + 3)
        self.normal_force = float(data.efc_force[rows][0])
        f_x, f_y, _ = data.efc_force[rows] @ [normal, *along]
        self.contact_force = float(f_x), float(f_y)
        _, *rates = data.efc_vel[rows]  # of the object on the finger
        tangent = math.cos(self.theta), math.sin(self.theta)
        slip = -sum(rate * (axis[:2] @ tangent) for rate, axis in zip(rates, along, strict=True))
        self.mode = STICK
        if abs(slip) > self._slow:
            self.mode = SLIP_LEFT if slip < 0.0 else SLIP_RIGHT

    @property
    def _slow(self) -> float:
        """A velocity that counts as none [m/s]."""
        return SLOW * self.config.belt_speed

    @property
    def _around(self) -> tuple[Pose, float, float, Array, float]:
        """What `clearance` takes."""
        path, radius = self.config.body.path, self.config.radius
        return self.object_pose, self.finger_x, self.finger_y, path, radius

    def _make_friction_uneven(self) -> None:
        mean = min(self.config.mu_c, MOST_FRICTION)
        self._model.pair_friction[0, :2] = self.faults.friction.mu_c(mean, self.sigma)
