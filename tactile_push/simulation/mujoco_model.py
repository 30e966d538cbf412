# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The rig as a MuJoCo model: bodies, contacts, servos, and solver settings that keep Coulomb's law.

The world is the belt, and the finger's base runs along it. The object rests on soft feet, little
spheres that stand for its support. Of all pairs of bodies only two kinds touch: feet and belt, tip
and object.

MuJoCo's contacts are springs whose friction is viscous up to Coulomb's bound. A contact obeys

    a + R f = a_ref,    a_ref = -stiffness * depth - damping * velocity,

R being (1 - d)/(d m) with its impedance d along the normal and R / impratio along the surface, in
which it only has -RATE * velocity on the right. What a sum of contacts is to do sets the numbers:

- A foot with the share w of the weight has d = 1/(1 + SOFTNESS/w), and its stiffness and damping go
  with SOFTNESS. Then all feet sink by `SAG` and swing back without overshoot, however many they
  are, and the loads shift between them as between springs.
- A contact that holds a friction f creeps with f R / (impratio RATE). With SOFTNESS of the weight
  on the feet and mu_s in the friction, feet keep to Coulomb's law from mu_s g SOFTNESS /
  (impratio RATE) on, 0.3 um/s with mu_s = 0.3, and a tip that sticks creeps no faster.
- An object that is left alone slows down with RATE times its velocity at the most.
- A contact that slips is lifted (the cones are convex) as if its reference acceleration were
  greater by mu RATE times the slip velocity; of SOFTNESS g that is 1.5 % at 5 mm/s, mu_s = 0.3.

A tip that could not give way upwards would hold the side of an object that its push tilts: friction
would carry a tenth of the weight, and halve the shift of the pressure.

References
----------
MuJoCo documentation, "Computation", sections on constraint model and solver.
"""

import math
from dataclasses import dataclass

import numpy as np

from tactile_push.mechanics import Outline, Support
from tactile_push.mechanics.contact import CURVATURE
from tactile_push.mechanics.quadrature import area_and_centroid, cells
from tactile_push.simulation.rig import RigConfig

GRAVITY = 9.81  # [m/s^2]
TIME_STEP = 1e-3  # longest [s]; twice as long a one is unstable, half as long a one no better
SAG = 50e-6  # of the feet under the object's weight [m]; a swing of 70 Hz
DENT = 30e-6  # of the tip by the force that moves the object [m]
SOFTNESS = 3.0  # R m at a contact with all the weight; see above
RATE = 300.0  # of friction below Coulomb's bound [1/s]
IMPRATIO = 1e5  # R along the normal to R along the surface
FOOT = 0.003  # radius of the feet [m], which touch the belt at their lowest points
TOLERANCE = (
    1e-14  # of the solver, which takes it relative to an inertia that the finger makes large
)
SERVO_INERTIA = 10.0  # of the joints with their gears [kg m^2]: no push is felt
SERVO_GAIN = 5e3  # [N m s/rad]: a lag of 2 ms; pushing a kilogram costs 0.2 % of the velocity
LIFT_STIFFNESS = 2e3  # of the finger upwards [N/m]: its friction carries hardly any weight
LIFT_INERTIA = 10.0  # the same as of the joints, for a contact that feels no push [kg]
CARRIER = 1e4  # mass of the base [kg], which runs along the belt whatever the push
MOST_FRICTION = 1e3  # stands for infinite friction
CELLS = 400  # of the outline, for the moment of inertia


@dataclass(frozen=True, eq=False)
class MujocoPhysics:
    """What MuJoCo has to know of the rig beside `RigConfig`.

    The friction on the belt is real here, so the support takes the place of the slider's c.

    Raises
    ------
    ValueError
        If a number is out of its range or the feet do not balance the object.
    """

    support: Support  #: feet in the frame of the slider's outline, with their shares of the weight
    mu_s: float  #: coefficient of friction between feet and belt, positive
    mass: float  #: of the object [kg]
    object_height: float  #: of the object [m], its centre of mass halfway up
    #: height of the tip's centre above the belt [m]; at 0 the push does not tilt the object
    push_height: float
    inertia: float | None = None  #: about the upright axis [kg m^2]; None for an even prism

    def __post_init__(self) -> None:
        for name in ('mu_s', 'mass', 'object_height'):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0.0):
                raise ValueError(f'{name}: expected a positive finite number, got {value}')
        if not 0.0 <= self.push_height < self.object_height:
            raise ValueError(
                f'push_height: expected a height of the object, 0 to less than '
                f'{self.object_height} m, got {self.push_height}'
            )
        if self.inertia is not None and not (math.isfinite(self.inertia) and self.inertia > 0.0):
            raise ValueError(f'inertia: expected a positive finite number, got {self.inertia}')
        if not math.hypot(*self.support.centre) <= 1e-9:
            raise ValueError(
                'support: expected loads that balance about the centre of mass, the origin, got '
                f'their centre at {self.support.centre} m'
            )


def model_xml(config: RigConfig, physics: MujocoPhysics) -> str:
    """Describe the rig to MuJoCo.

    Parameters
    ----------
    config : RigConfig
        What the rig is made of and where it starts.
    physics : MujocoPhysics
        What else there is to know of it.

    Returns
    -------
    str
        A model in MJCF. Its bodies are `object` and `tip`, its geoms beside the feet `belt`,
        `side` and `tip`, its joints `base`, `proximal`, `distal`, if it holds the tip `wrist`,
        and `lift`; its first pair is `push`.
    """
    finger, up = config.finger, physics.push_height
    support = physics.support
    shares = support.loads / support.loads.sum()
    loaded = [(x, y, w) for (x, y), w in zip(support.points, shares, strict=True) if w > 0.0]
    feet = ''.join(
        f'<geom name="foot{i}" type="sphere" size="{FOOT}" pos="{x} {y} {FOOT}"/>'
        for i, (x, y, _) in enumerate(loaded)
    )
    on_the_belt = ''.join(
        f'<pair geom1="belt" geom2="foot{i}" {_contact(physics.mu_s, w, GRAVITY / SAG)}/>'
        for i, (_, _, w) in enumerate(loaded)
    )
    push = _contact(min(config.mu_c, MOST_FRICTION), 1.0, physics.mu_s * GRAVITY / DENT)
    mass, middle = physics.mass, physics.object_height / 2.0
    inertia = ' '.join(map(str, _inertia(config.slider.outline, physics)))
    shape, side = _side(config.slider.outline, config.radius, physics.object_height)
    hinge = f'type="hinge" axis="0 0 1" armature="{SERVO_INERTIA}"'
    light = '<inertial pos="0 0 0" mass="1e-3" diaginertia="1e-6 1e-6 1e-6"/>'
    lift = (
        f'<joint name="lift" type="slide" axis="0 0 1" armature="{LIFT_INERTIA}" '
        f'stiffness="{LIFT_STIFFNESS}" damping="{2.0 * math.sqrt(LIFT_INERTIA * LIFT_STIFFNESS)}"/>'
    )
    wrist = wrist_servo = ''
    if not config.tip_turns:
        wrist = f'<joint name="wrist" {hinge}/>'
        wrist_servo = f'<velocity joint="wrist" kv="{SERVO_GAIN}"/>'
    return f"""
<mujoco>
  <compiler angle="radian"/>
  <option timestep="{TIME_STEP}" integrator="Euler" gravity="0 0 {-GRAVITY}" cone="elliptic"
    impratio="{IMPRATIO}" solver="Newton" tolerance="{TOLERANCE}"/>
  <default><geom contype="0" conaffinity="0" mass="0"/><pair condim="3"/></default>
  <asset>{shape}</asset>
  <worldbody>
    <geom name="belt" type="plane" size="1 1 1"/>
    <body name="object">
      <freejoint/>
      <inertial pos="0 0 {middle}" mass="{mass}" diaginertia="{inertia}"/>
      {side}{feet}
    </body>
    <body euler="0 0 {finger.mount_angle}" pos="0 0 {up}">
      <joint name="base" type="slide" axis="{math.sin(finger.mount_angle)}
        {math.cos(finger.mount_angle)} 0"/>
      <inertial pos="0 0 0" mass="{CARRIER}" diaginertia="1 1 1"/>
      <body>
        <joint name="proximal" {hinge}/>{light}
        <body pos="{finger.proximal_length} 0 0">
          <joint name="distal" {hinge}/>{light}
          <body name="tip" pos="{finger.distal_length} 0 0">
            {wrist}{lift}{light}
            <geom name="tip" type="sphere" size="{config.radius}"/>
          </body>
        </body>
      </body>
    </body>
  </worldbody>
  <contact><pair name="push" geom1="tip" geom2="side" {push}/>{on_the_belt}</contact>
  <actuator>
    <velocity joint="proximal" kv="{SERVO_GAIN}"/>
    <velocity joint="distal" kv="{SERVO_GAIN}"/>
    {wrist_servo}
  </actuator>
</mujoco>"""


def _contact(mu: float, share: float, square: float) -> str:
    """Return the attributes of a contact: its load's share, its spring's angular frequency^2."""
    softness = SOFTNESS / share  # R m
    impedance = softness_to_impedance(softness)
    # MuJoCo divides these by the impedance where they act.
    stiffness, damping = (SOFTNESS * impedance * one for one in (square, 2.0 * math.sqrt(square)))
    return (
        f'friction="{mu} {mu} 0 0 0" solref="{-stiffness} {-damping}" '
        f'solreffriction="-1e-9 {-RATE * impedance}" solimp="{impedance} {impedance} 1"'
    )


def softness_to_impedance(softness: float) -> float:
    """Return MuJoCo's impedance d of a contact with R m = (1 - d)/d."""
    return 1.0 / (1.0 + softness)


def _side(outline: Outline, radius: float, height: float) -> tuple[str, str]:
    """Return the asset and the geom of the object's side, which goes on below the belt."""
    pieces = outline.path(radius)[:-1]
    if len(pieces) == 1:
        round_radius = 1.0 / pieces[0, CURVATURE] - radius
        half, middle = (height + radius) / 2.0, (height - radius) / 2.0
        size = f'size="{round_radius} {half}" pos="0 0 {middle}"'
        return '', f'<geom name="side" type="cylinder" {size}/>'
    if (outline.pieces[:, 3:] > 0.0).all(axis=1).any():
        raise ValueError('outline: expected a polygon or a circle about the origin, got arcs')
    corners = outline.points(math.inf).tolist()
    vertices = ' '.join(f'{x} {y} {z}' for z in (-radius, height) for x, y in corners)
    return (
        f'<mesh name="side" vertex="{vertices}"/>',
        '<geom name="side" type="mesh" mesh="side"/>',
    )


def _inertia(outline: Outline, physics: MujocoPhysics) -> tuple[float, float, float]:
    """Return the moments of inertia about the centre of mass [kg m^2], of a prism."""
    area, _ = area_and_centroid(outline)
    points, areas = cells(outline, area / CELLS)
    x, y = physics.mass * (areas @ points**2) / areas.sum()
    upright = x + y if physics.inertia is None else physics.inertia
    half = physics.mass * physics.object_height**2 / 12.0
    return tuple(np.array([upright / 2.0 + half, upright / 2.0 + half, upright]))
