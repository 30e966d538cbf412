# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The rig that stands in for the hardware: belt, object, finger and sensor (Section V.A)."""

import math
from dataclasses import dataclass
from functools import cached_property

from tactile_push import paper
from tactile_push.interface import POINTS
from tactile_push.mechanics import (
    CENTRE,
    FREE,
    MODES,
    Body,
    Finger,
    Outline,
    Pose,
    Slider,
    check_friction,
    clearance,
    contact,
    friction_cone,
    move_finger,
    tangent_angle,
)
from tactile_push.mechanics.contact import piece_at, reach, rotated
from tactile_push.simulation.faults import NO_FAULTS, Faults
from tactile_push.simulation.lift import Lift
from tactile_push.simulation.servo import DelayLine, lagged, quantised
from tactile_push.simulation.tip import EVEN_TURN, Tip, move_tip
from tactile_push.tactile import (
    NO_CONTACT,
    FingerPose,
    PlanarFinger,
    Reading,
    reading_of_contact,
)
from tactile_push.tactile.planar_finger import USUAL_FINGER, link_angles, pole_angle

MOST_TURNS = 100  # parts of one step in each of which the tip turns evenly; picked


@dataclass(frozen=True)
class RigConfig:
    """What the rig is made of and where it starts.

    The finger starts with its pole along the belt and touches the object.

    Raises
    ------
    ValueError
        If a number is out of its range or the start is no contact that pushes.
    """

    slider: Slider  #: what the finger pushes, on the first piece of its outline at the start
    mu_c: float  #: coefficient of friction between finger and object, 0 to infinity
    theta: float  #: angle of the pushed edge or tangent at the start [rad]
    d: float | None  #: contact along the edge at the start [m]; None for the smallest
    belt_speed: float = paper.BELT_SPEED  #: speed of the belt, v_y [m/s]
    radius: float = paper.FINGER_RADIUS  #: effective radius of the finger's disk [m]
    finger: PlanarFinger = USUAL_FINGER  #: its links
    tip_turns: bool = True  #: whether the tip turns with the last link; else a wrist holds it
    #: which point of a turning tip follows the command, one of `POINTS`; the centre of the disk
    #: stays where it is along the belt
    commanded_point: str = POINTS[CENTRE]
    f_max: float = 2.7  #: force that moves the object straight on [N]

    def __post_init__(self) -> None:
        for name in ('belt_speed', 'radius', 'f_max'):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0.0):
                raise ValueError(f'{name}: expected a positive finite number, got {value}')
        check_friction(self.mu_c)
        if self.commanded_point not in POINTS:
            raise ValueError(
                f'commanded_point: expected one of {POINTS}, got {self.commanded_point!r}'
            )
        if not abs(self.theta) < math.pi / 2.0:
            raise ValueError(
                f'theta: expected an edge that faces the belt, |theta| < pi/2 rad, got {self.theta}'
            )
        _ = self.sigma  # which refuses a start that is no contact

    @cached_property
    def body(self) -> Body:
        """The object as the compiled functions take it."""
        return self.slider.body(self.radius)

    @cached_property
    def sigma(self) -> float:
        """Where the contact starts along the path of the disk's centre around the object [m]."""
        return self.slider.outline.sigma(self.radius, d=self.d)

    @cached_property
    def tip(self) -> Tip:
        """The last link as the compiled functions take it, with the knuckle left of the belt."""
        links = self.finger
        home = links.forward(math.pi - links.mount_angle, -math.pi / 2.0)
        point = POINTS.index(self.commanded_point)
        return Tip(links.proximal_length, links.distal_length, home.x, home.y, point)


def paper_block(
    theta: float = paper.THETA_INITIAL,
    d: float = paper.D_INITIAL,
    c: float = paper.C_UNIFORM,
    mu_c: float = math.inf,
) -> RigConfig:
    """Return the paper's rectangular steel block, 5 cm x 4.75 cm, pushed at the 5 cm edge.

    The finger's disk keeps its orientation, as in the paper's equations (footnote 3).

    Parameters
    ----------
    theta : float, optional
        Angle of the edge at the start [rad]; fig. 8's by default.
    d : float, optional
        Contact along the edge at the start [m]; fig. 8's by default.
    c : float, optional
        Ratio m_max / f_max [m]; uniform support by default.
    mu_c : float, optional
        Coefficient of friction between finger and object.

    Returns
    -------
    RigConfig
        The rig.
    """
    block = Outline.rectangle(paper.BLOCK_EDGE, paper.BLOCK_DEPTH)
    return RigConfig(Slider(block, c), mu_c, theta, d, tip_turns=False)


def paper_disk(theta: float = paper.THETA_INITIAL, mu_c: float = math.inf) -> RigConfig:
    """Return the paper's steel disk of radius 2.85 cm, its support uniform.

    The finger's disk keeps its orientation, as in the paper's equations (footnote 3).

    Parameters
    ----------
    theta : float, optional
        Angle of the tangent at the start [rad].
    mu_c : float, optional
        Coefficient of friction between finger and object.

    Returns
    -------
    RigConfig
        The rig.
    """
    disk = Outline.circle(paper.DISK_RADIUS)
    slider = Slider(disk, 2.0 / 3.0 * paper.DISK_RADIUS)
    return RigConfig(slider, mu_c, theta, 0.0, tip_turns=False)


class Rig(Lift):
    """The rig in motion.

    Parameters
    ----------
    config : RigConfig
        What the rig is made of and where it starts.
    faults : Faults, optional
        How far it is from a perfect one; its sensor is left to whoever reads. They may be replaced
        at any time.
    """

    def __init__(self, config: RigConfig, faults: Faults = NO_FAULTS) -> None:
        super().__init__()
        self.config = config
        self.faults = faults
        self._body = config.body
        self._tip = config.tip
        self._commands: DelayLine[tuple[float, ...]] = DelayLine((0.0, 0.0))
        self.time = 0.0  #: how long it has been in motion [s]
        self.v_x = 0.0  #: the finger's velocity across the belt at the end of the last step [m/s]
        self.v_along = 0.0  #: its own one along the belt, against the belt's motion [m/s]
        self.v_y = 0.0  #: the belt's speed at the end of the last step [m/s]
        self.finger_x = 0.0  #: centre of the finger's disk on the belt, from its start [m]
        self.along = 0.0  #: how far it has moved along the belt by itself, from its line [m]
        self.belt_travel = 0.0  #: how far the belt has moved [m]
        self.psi = math.pi / 2.0  #: angle of the finger tip's pole in `finger_base` [rad]
        self.touching = True  #: whether finger and object touch
        self.sigma = config.sigma  #: position of the disk along its path around the object [m]
        self.mode = FREE  #: how the contact moved at the end of the last step, an index of `MODES`
        self.phi = math.pi / 2.0  #: direction of the finger on the belt in the last step [rad]
        self.at_workspace_limit = False  #: whether the finger could not follow its velocity
        # How the object moved last, in its own axes; None if it has not moved.
        self._slid: tuple[float, float, float] | None = None
        #: centre of mass and orientation of the object on the belt
        self.object_pose = self._first_pose()

    def _first_pose(self) -> Pose:
        """Return the pose on the belt of an object that the finger touches as configured."""
        theta, path = self.config.theta, self._body.path
        d, l = self._contact
        x, y = reach(theta, d, l, self.config.radius)
        return Pose(self.finger_x - x, self.finger_y - y, theta - tangent_angle(self.sigma, path))

    def _come_off(self) -> None:
        self.lifted, self.touching = True, False

    def _touch_next(self) -> None:
        self.touching = True
        self.sigma, self._slid = self.config.sigma, None
        self.object_pose = self._first_pose()

    @property
    def finger_y(self) -> float:
        """Centre of the finger's disk on the belt along it, where it moves at +v_y [m]."""
        return self.belt_travel + self.along

    @property
    def theta(self) -> float:
        """Angle of the edge or tangent that the finger touches, or touched last [rad]."""
        return self.object_pose.angle + tangent_angle(self.sigma, self._body.path)

    @property
    def d(self) -> float:
        """The paper's d of the contact [m]."""
        return self._contact[0]

    @property
    def _contact(self) -> tuple[float, float]:
        """The paper's d and l of the contact [m]."""
        piece = piece_at(self.sigma, self._body.path)
        _, _, d, l = contact(self.sigma, piece, self._body.path, self.config.radius)
        return d, l

    @property
    def _friction_cone(self) -> tuple[float, float]:
        """The friction cone at the contact, as `friction_cone` returns it."""
        return friction_cone(self.faults.friction.mu_c(self.config.mu_c, self.sigma))

    @property
    def gap(self) -> float:
        """Distance between finger and object [m]."""
        x, y, radius = self.finger_x, self.finger_y, self.config.radius
        _, gap = clearance(self.object_pose, x, y, self._body.path, radius)
        return gap

    @property
    def mode_name(self) -> str:
        """The contact's mode as a word."""
        return MODES[self.mode]

    @property
    def joints(self) -> tuple[float, ...]:
        """Angles of the finger's two moving joints and, if it has one, of the wrist [rad]."""
        finger = self.config.finger
        pose = self.finger_pose
        links = finger.inverse(pose.x, pose.y)
        if self.config.tip_turns:
            return links
        return *links, self.psi - pole_angle(finger.mount_angle, links)

    @property
    def finger_pose(self) -> FingerPose:
        """Pose of the finger tip in `finger_base`."""
        return FingerPose(self._tip.x + self.finger_x, self._tip.y + self.along, self.psi)

    @property
    def object_in_finger_disk(self) -> Pose:
        """Pose of the object in the frame `finger_disk`."""
        pose = self.object_pose
        return Pose(pose.x - self.finger_x, pose.y - self.finger_y, pose.angle)

    @property
    def contact_directions(self) -> dict[str, tuple[float, float]]:
        """Unit vectors at the contact: 'normal', 'left' and 'right' (friction cone), 'push'."""
        cos_alpha, sin_alpha = self._friction_cone
        return directions(self.theta, math.atan2(sin_alpha, cos_alpha), self.phi)

    @property
    def is_loose(self) -> bool:
        """Whether the object presses less on the finger than one that the belt has carried there.

        It never does here; in MuJoCo it may.
        """
        return False

    @property
    def contact_force(self) -> tuple[float, float]:
        """What the finger exerts on the object, x and y in `finger_base` [N].

        The limit surface gives it from the object's last motion. Before the first one the finger
        pushes straight, and while the belt stands it goes on to push.
        """
        if not self.touching:
            return 0.0, 0.0
        f_max, angle = self.config.f_max, self.object_pose.angle
        if self._slid is None:
            return -f_max * math.sin(self.theta), f_max * math.cos(self.theta)
        f_x, f_y, _ = f_max * self.config.slider.wrench(self._slid)
        return rotated(float(f_x), float(f_y), angle)

    def reading(self) -> Reading:
        """Read the sensor.

        Returns
        -------
        Reading
            Azimuth and elevation [rad]; NaN without contact or behind the hemisphere.
        """
        if not self.touching:
            return NO_CONTACT
        return reading_of_contact(self.theta, self.psi) or NO_CONTACT

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
        if duration == 0.0:
            return
        servo = self.faults.servo
        commands = v_x, v_along
        for arrived, left in self._commands.arriving(commands, self.time, duration, servo.delay):
            across, along = (quantised(one, servo.velocity_quantum) for one in arrived)
            while True:
                longest = min(left, self._even_time(across, duration, belt_running))
                # Both for as long as both are nearly straight.
                longest, _, _ = lagged(self.v_along, along, servo.time_constant, longest)
                elapsed, mean, after = lagged(self.v_x, across, servo.time_constant, longest)
                _, mean_along, self.v_along = lagged(
                    self.v_along, along, servo.time_constant, elapsed
                )
                self.v_x = after
                self._move_within_limits(mean, mean_along, elapsed, belt_running)
                if elapsed >= left:
                    break
                left -= elapsed
        belt_speed = self.faults.belt.speed(self.config.belt_speed, self.time)
        self.v_y = belt_speed if belt_running else 0.0

    def _even_time(self, command: float, duration: float, belt_running: bool) -> float:
        """Return for how long an even motion may stand for the true one in a step [s]."""
        across = max(abs(self.v_x), abs(command))
        even = self.faults.belt.straight(self.config.belt_speed) if belt_running else math.inf
        even = min(even, self.faults.friction.even(math.hypot(across, self.config.belt_speed)))
        if self.config.tip_turns and across * duration > EVEN_TURN:
            even = min(even, duration / math.ceil(min(across * duration / EVEN_TURN, MOST_TURNS)))
        return even

    def _move_within_limits(
        self, v_x: float, v_along: float, duration: float, belt_running: bool
    ) -> None:
        """Move evenly, and stop the finger where it can go no further."""
        x = self._tip.x + self.finger_x
        v_centre, psi = self._follow(v_x, v_along, duration)
        inside = 0.0
        if not math.isnan(psi):
            inside = self.faults.workspace.time_inside(x, v_centre, duration)
        if inside > 0.0:
            if inside < duration:
                psi = self._psi(x + v_centre * inside, v_along * inside)
            self._move(v_centre, psi, inside, belt_running, v_along)
        if inside < duration:
            self.at_workspace_limit = True
            self.v_x = self.v_along = 0.0
            self._move(0.0, self.psi, duration - inside, belt_running)

    def _follow(self, v_x: float, v_along: float, duration: float) -> tuple[float, float]:
        """Return the mean velocity of the disk's centre and psi at the end; NaN out of reach.

        While the finger moves along the belt it is the disk's centre that goes across.
        """
        x, way = self._tip.x + self.finger_x, v_x * duration
        if self._tip.point == CENTRE or not self.config.tip_turns or v_along != 0.0:
            return v_x, self._psi(x + way, v_along * duration)
        tip = self._tip._replace(y=self._tip.y + self.along)
        after, psi = move_tip(tip, x, self.psi, way, self.theta, self.config.radius)
        return (after - x) / duration, psi

    def _psi(self, x: float, along: float = 0.0) -> float:
        """Return psi with the disk's centre at x, and farther along; NaN out of reach."""
        y = self._tip.y + self.along + along
        knuckle, distal = link_angles(x, y, self._tip.a, self._tip.b)
        return knuckle + distal if self.config.tip_turns or math.isnan(distal) else self.psi

    def _move(
        self, v_x: float, psi: float, duration: float, belt_running: bool, v_along: float = 0.0
    ) -> None:
        """Move the disk's centre and the belt straight on, and what they push."""
        belt_speed = 0.0
        if belt_running:
            belt_speed = self.faults.belt.mean_speed(self.config.belt_speed, self.time, duration)
        v_y = belt_speed + v_along
        self.time += duration
        if self.lifted or v_x == v_y == 0.0:
            self.mode = FREE
        if not v_x == v_y == 0.0:
            self.phi = math.atan2(v_y, v_x)
            if not self.lifted:
                turning = (psi - self.psi) / duration
                self._push(v_x, v_y, turning, min(duration, self.free_in))
        self.belt_travel += belt_speed * duration
        self.finger_x += v_x * duration
        self.along += v_along * duration
        self.psi = psi
        self._go_on_lifting(duration)

    def _push(self, v_x: float, v_y: float, turning: float, duration: float) -> None:
        """Let the finger, which moves on the belt and turns evenly, move what is in its way."""
        before = self.object_pose
        self.object_pose, self.sigma, self.touching, self.mode = move_finger(
            *(self.object_pose, self.sigma, self.touching, self.finger_x, self.finger_y),
            *(v_x, v_y, duration, self._body, Finger(*self._friction_cone, self.config.radius)),
            turning,
        )
        x, y, angle = (a - b for a, b in zip(self.object_pose, before, strict=True))
        if self.touching and (x or y or angle):
            self._slid = *rotated(x, y, -self.object_pose.angle), angle


def directions(theta: float, alpha: float, phi: float) -> dict[str, tuple[float, float]]:
    """Return unit vectors at a contact.

    Parameters
    ----------
    theta, alpha, phi : float
        Angle of the edge or tangent, half angle of the friction cone, direction of the push [rad].

    Returns
    -------
    dict of str to tuple of float
        'normal', 'left' and 'right' (friction cone), 'push'.
    """
    normal = theta + math.pi / 2.0
    angles = {'normal': normal, 'left': normal + alpha, 'right': normal - alpha, 'push': phi}
    return {name: (math.cos(angle), math.sin(angle)) for name, angle in angles.items()}
