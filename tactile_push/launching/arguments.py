# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The arguments of the launch files, declared like the parameters of nodes."""

import difflib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

import yaml

from tactile_push import paper
from tactile_push.interface import LAWS, PLANTS, SENSORS, SENTENCE, SIM_PLANT
from tactile_push.parameters import (
    FingerServoParameters,
    PushControllerParameters,
    SimPlantParameters,
    shared,
)
from tactile_push.parameters.parameter import NodeParameters, Parameter, parameter

ROBOTS = JOINTS, AXIS, _ = ('finger', 'axis', 'none')
OBJECTS = (paper.BLOCK, paper.DISK)
LAW, PLANT = PushControllerParameters(), SimPlantParameters()
SERVO = FingerServoParameters()
LIKENESS = 0.8  # of a name and the one that was meant; a file that includes ours has its own names
OBEYS = (
    'law of push_controller: push turns the object to theta_desired, place brings it to the goals '
    'on the topic place/goal and lets it go there, steer carries it straight ahead at the x of the '
    'goal, settle turns it to the theta of the goal by all that is known'
)
SHOWS = 'show the run on a page for browsers, whose address live_page prints'


@dataclass(frozen=True)
class LaunchArguments(NodeParameters):
    """Values of a launch file's arguments; each subclass declares those of one launch file."""

    FROM_FILE: ClassVar[bool] = False  # whether a file says what is not given

    @classmethod
    def read(cls, texts: Mapping[str, str]) -> dict[str, Any]:
        """Read the arguments as a command line gives them.

        Parameters
        ----------
        texts : mapping of str to str
            Texts by argument, perhaps with others that are not ours. One that is empty was not
            given.

        Returns
        -------
        dict of str to object
            Values of the arguments that were given.

        Raises
        ------
        ValueError
            If a text is no value of its argument, or a name looks like a slip of ours.
        """
        names = [known.name for known in cls.declared()]
        for name in texts.keys() - names:
            for similar in difflib.get_close_matches(name, names, 1, LIKENESS):
                raise ValueError(f'argument {name}: unknown, did you mean {similar}?')
        return {
            known.name: _value(known, texts[known.name])
            for known in cls.declared()
            if texts.get(known.name)
        }


@dataclass(frozen=True)
class DemoArguments(LaunchArguments):
    """What `demo.launch.py` can be told: the object, who simulates it, and how."""

    # fmt: off
    object: str = parameter(paper.BLOCK, '', "the paper's object to push", choices=OBJECTS)
    plant: str = parameter(SIM_PLANT, '', 'which node simulates', choices=PLANTS)
    law: str = parameter(LAW.law, '', OBEYS, choices=LAWS)
    kp: float = parameter(LAW.kp, 'rad/rad',
        'proportional gain of the control law', 0.0, 100.0)
    kd: float = parameter(LAW.kd, 'rad/rad',
        'derivative gain of the control law', 0.0, 1000.0)
    real_time_factor: float = parameter(PLANT.real_time_factor, 's/s',
        'simulated seconds a second, at the most', 0.01, 100.0)
    device: str = parameter(PLANT.device, '', 'where the simulated sensor and the driver meet')
    rviz: bool = parameter(True, '', 'start RViz')
    watch: bool = parameter(True, '', SHOWS)
    # fmt: on


@dataclass(frozen=True)
class FingerArguments(LaunchArguments):
    """What `finger.launch.py` can be told, and `config/hardware.yaml` says below `finger_launch`.

    The second half are facts about the machine. Each node that declares a parameter of that name
    gets the value, and so does the robot description: no two of them can disagree.
    """

    FROM_FILE: ClassVar[bool] = True

    # fmt: off
    config: str = parameter('', '',
        "parameter file of the machine; empty for the package's config/hardware.yaml")
    sensor: str = parameter(SENTENCE, '', 'kind of sensor in the finger tip', choices=SENSORS)
    sensor_topic: str = parameter('', '',
        "topic of the sensor's driver: of its wrenches or of its images; empty for wrench or image")
    calibration: str = parameter('', '',
        "parameter file of the sensor's node, as `tactile_push calibrate` writes it; empty if it "
        'needs none')
    robot: str = parameter(JOINTS, '',
        'what moves the tip: finger is the finger of two joints, whose description is published; '
        'axis is one joint that slides a tip that does not turn; none is a machine without joints '
        'that anybody has to know, whose tip does not turn', choices=ROBOTS)
    servo: bool = parameter(True, '',
        'let finger_servo move the joints by their velocities; false if the machine takes '
        'finger/cmd_vel itself')
    object: str = parameter(paper.BLOCK, '',
        f"what is pushed: {' or '.join(OBJECTS)} of the paper, or a parameter file of one's own")
    law: str = parameter(LAW.law, '', OBEYS, choices=LAWS)
    namespace: str = parameter('', '', 'namespace of all nodes; a second finger needs one')
    sim: bool = parameter(False, '',
        'let sim_plant take the place of the machine, on simulated time and this computer alone')
    record: bool = parameter(False, '', 'record the topics into a bag')
    rviz: bool = parameter(False, '', 'start RViz')
    watch: bool = parameter(False, '', SHOWS)
    belt_speed: float = shared.belt_speed
    finger_radius: float = shared.finger_radius
    proximal_length: float = shared.proximal_length
    distal_length: float = shared.distal_length
    mount_angle: float = shared.mount_angle
    joint_names: list[str] = parameter(shared.JOINT_NAMES, '',
        'the two moving joints of the finger in joint_states from the base to the tip, and a wrist '
        'that holds the tip straight if there is one; of an axis its only joint')
    joint_min: list[float] = parameter(SERVO.joint_min, 'rad',
        'least angle of each of the two; of an axis its least position [m]')
    joint_max: list[float] = parameter(SERVO.joint_max, 'rad',
        'greatest angle of each of the two; of an axis its greatest position [m]')
    joint_speed: list[float] = parameter(SERVO.joint_speed, 'rad/s',
        'greatest speed of each of the two; of an axis in m/s')
    # fmt: on

    def __post_init__(self) -> None:
        fewest, most, names, numbers = 2, 3, 'two or three different names', 'two numbers'
        if self.robot == AXIS:
            fewest, most, names, numbers = 1, 1, 'one name for an axis', 'one number for an axis'
        if not fewest <= len(set(self.joint_names)) == len(self.joint_names) <= most:
            raise ValueError(f'joint_names: expected {names}, got {self.joint_names}')
        for name in BOUNDS:
            if len(getattr(self, name)) != fewest:
                raise ValueError(f'{name}: expected {numbers}, got {getattr(self, name)}')

    @property
    def machine(self) -> dict[str, Any]:
        """Facts about the machine by name, for whoever declares a parameter of that name."""
        return {name: getattr(self, name) for name in MACHINE}


BOUNDS = ('joint_min', 'joint_max', 'joint_speed')
MACHINE = (
    'belt_speed',
    'finger_radius',
    'proximal_length',
    'distal_length',
    'mount_angle',
    'joint_names',
    *BOUNDS,
)


def _value(known: Parameter, text: str) -> Any:
    """Return the value that a text is; ValueError if it is none of the argument's."""
    value: Any = text
    try:
        if isinstance(known.default, bool):
            value = {'true': True, 'false': False}[text.lower()]
        elif isinstance(known.default, float):
            value = float(text)
        elif isinstance(known.default, list):
            value = yaml.safe_load(text)
    except (KeyError, ValueError, yaml.YAMLError):
        value = None
    if not known.takes(value):
        raise ValueError(f'argument {known.name}: expected {known.expected()}, got {text!r}')
    return value
