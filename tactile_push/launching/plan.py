# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Which programs a launch file starts, and with which parameters.

Everything is read and checked here, before anything is started. A node's values come from the
object's file, the machine's file, the sensor's calibration and then the launch file itself; of two
values for the same parameter the later one counts.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from tactile_push.interface import (
    ACTIVE_SENSING,
    BAG_RECORDER,
    CAMERA,
    COMPRESSED_IMAGE,
    CONTACT_GEOMETRY,
    FINGER_DISK,
    FINGER_SERVO,
    FORCE_TORQUE,
    IMAGE,
    JOINT_VELOCITIES,
    LINEAR,
    LIVE_PAGE,
    PLANTS,
    PUSH_CONTROLLER,
    SENTENCE,
    SIM_PLANT,
    STRAIGHT,
    WRENCH,
    WRENCH_SENSOR,
    WRIST_JOINT,
)
from tactile_push.launching.arguments import (
    AXIS,
    BOUNDS,
    JOINTS,
    DemoArguments,
    FingerArguments,
)
from tactile_push.launching.files import launch_values, object_file, own_name, read_file
from tactile_push.launching.robot import robot_description
from tactile_push.needs_aiohttp import missing_for_the_page
from tactile_push.parameters import PARAMETERS, config_file, shared
from tactile_push.parameters.ros_file import Sections, matches
from tactile_push.parameters.sensor_kinds import SENSOR_KINDS
from tactile_push.parameters.slips import meant

OWN_PACKAGE = 'tactile_push'
STATE_PUBLISHER, RVIZ = 'robot_state_publisher', 'rviz2'
# tf in the finger's own namespace: two fingers name their frames alike.
OWN_TF = (('/tf', 'tf'), ('/tf_static', 'tf_static'))


@dataclass(frozen=True)
class Program:
    """A program that a launch file starts."""

    package: str  #: ROS package that has it
    executable: str  #: its name, which its node has too
    parameters: Mapping[str, Any]  #: values of the node's parameters by name
    arguments: tuple[str, ...] = ()  #: on its command line, before those of ROS
    remappings: tuple[tuple[str, str], ...] = ()  #: names of topics, and what they become
    without: str = ''  #: argument of the launch file that leaves it out; '' if none does
    only_shows: bool = False  #: whether the others go on when it fails


@dataclass(frozen=True)
class Plan:
    """What a launch file starts."""

    programs: tuple[Program, ...]  #: in the order in which they start
    namespace: str  #: of all nodes
    simulated: bool  #: whether the nodes talk on this machine alone


def demo_plan(texts: Mapping[str, str]) -> Plan:
    """Plan the demonstration.

    Parameters
    ----------
    texts : mapping of str to str
        Arguments of `demo.launch.py`; one that is empty was not given.

    Returns
    -------
    Plan
        The plan.

    Raises
    ------
    ValueError
        If an argument is refused.
    """
    p = DemoArguments.of(DemoArguments.read(texts))
    values = {
        **{'law': p.law, 'kp': p.kp, 'kd': p.kd},
        **{'device': p.device, 'real_time_factor': p.real_time_factor},
        **{'publish_clock': True, 'use_sim_time': True},
    }
    machine = FingerArguments().machine
    files = [read_file(config_file(f'{p.object}.yaml'))]
    names = [p.plant, SENSOR_KINDS[SENTENCE].node, *_LOOP]
    nodes = [_node(node, '', files, values) for node in names]
    if p.watch:
        nodes.append(_page('', files, values))
    shown = _shown(machine, values, rviz=p.rviz)
    return Plan((*shown, *nodes), '', simulated=True)


def finger_plan(texts: Mapping[str, str]) -> Plan:
    """Plan what runs a finger on a machine, or its simulation.

    Parameters
    ----------
    texts : mapping of str to str
        Arguments of `finger.launch.py`; one that is empty was not given.

    Returns
    -------
    Plan
        The plan.

    Raises
    ------
    ValueError
        If an argument or a file is refused.
    """
    given = FingerArguments.read(texts)
    file = Path(given.get('config') or config_file('hardware.yaml'))
    hardware = read_file(file)
    told = {**launch_values(hardware, file), **given}
    p = FingerArguments.of(told)
    pushed = object_file(p)
    # Of a hard tip the hemisphere has the disk's radius; a file may know better.
    tip: Sections = {f'/**/{WRENCH_SENSOR}': {'tip_radius': p.finger_radius}}
    files = [tip, read_file(pushed), hardware]
    kind, values = SENSOR_KINDS[p.sensor], _values(p)
    if p.calibration:
        files.append(_calibration(p, kind.node))
    own = {kind.node: kind.parameters, ACTIVE_SENSING: kind.sensing} if p.sim else {}
    if 'law' in told:  # or else a file may say it of the controller
        own[PUSH_CONTROLLER] = {'law': p.law}
    names = [kind.node, *_LOOP]
    if moved := _moved_by_servo(p, values):
        names.append(FINGER_SERVO)
        own[FINGER_SERVO] = moved
    nodes = [_node(node, p.namespace, files, values, own.get(node)) for node in names]
    if p.sim:
        if not any(own_name(section) == SIM_PLANT for section in files[1]):
            raise ValueError(f'{pushed}: expected a section of {SIM_PLANT} with the object')
        plant = _plant_values(p, kind.plant, nodes[0])
        nodes.insert(0, _node(SIM_PLANT, p.namespace, files, values, plant))
    else:
        nodes[0] = replace(nodes[0], remappings=_heard_of(p))
    if p.record:
        nodes.append(_node(BAG_RECORDER, p.namespace, files, values))
    if p.watch:
        nodes.append(_page(p.namespace, files, values))
    shown = _shown(values if p.robot == JOINTS else None, values, rviz=p.rviz)
    return Plan((*shown, *nodes), p.namespace, p.sim)


def _calibration(p: FingerArguments, node: str) -> Sections:
    """Return the sections of the calibration; ValueError if it is of another sensor or tip."""
    sections = read_file(Path(p.calibration))
    place = f'/{p.namespace}/{node}' if p.namespace else f'/{node}'
    ours = [values for section, values in sections.items() if matches(section, place)]
    if not ours:
        raise ValueError(
            f'{p.calibration}: expected the calibration of a {p.sensor}, for {node}, got one for '
            f'{", ".join(map(own_name, sections)) or "none"}'
        )
    for radius in (values['tip_radius'] for values in ours if 'tip_radius' in values):
        if not 1.0 / MOST_OTHER <= radius / p.finger_radius <= MOST_OTHER:
            raise ValueError(
                f'{p.calibration}: tip_radius: expected that of a tip with finger_radius '
                f'{p.finger_radius:g} m, got {radius:g} m, which is that of another tip'
            )
    return sections


# The paper's tip has 16 mm and touches at 13.5 mm from its centre. Radii that differ by more than
# this factor are not of one tip. Picked.
MOST_OTHER = 1.5
_LOOP = (CONTACT_GEOMETRY, PUSH_CONTROLLER, ACTIVE_SENSING)


def _values(p: FingerArguments) -> dict[str, Any]:
    """Return values for all nodes that declare parameters of these names."""
    values = p.machine
    if p.robot != JOINTS:
        values = {name: value for name, value in values.items() if name not in _OF_JOINTS}
        values |= {'use_joint_states': False, 'without_psi': STRAIGHT}
    elif p.sim:
        # As the plant names its joints, whatever those of the machine are called.
        values['joint_names'] = [*shared.JOINT_NAMES, WRIST_JOINT][: len(p.joint_names)]
    if p.sim:
        values |= {'device': shared.DEVICE, 'use_sim_time': True}
    return values


_OF_JOINTS = ('joint_names', *BOUNDS)  # which mean nothing without a finger of joints


def _moved_by_servo(p: FingerArguments, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return what the servo is told of the joints that it moves; empty if it moves none."""
    if p.servo and p.robot == JOINTS:
        return {'joint_names': values['joint_names'][:2]}  # a wrist is another's
    if p.servo and p.robot == AXIS and not p.sim:  # the simulated finger has no axis
        return {'kinematics': LINEAR, **{name: p.machine[name] for name in _OF_JOINTS}}
    return {}


def _plant_values(p: FingerArguments, kind: Mapping[str, Any], sensor: Program) -> dict[str, Any]:
    """Return what the plant is told so that it is like the machine, with a kind of sensor."""
    turns = p.robot == JOINTS and len(p.joint_names) == 2
    moved_by = {'commands': JOINT_VELOCITIES} if p.robot == JOINTS and p.servo else {}
    mount = {name: sensor.parameters[name] for name in _MOUNT if name in sensor.parameters}
    return {'publish_clock': True, 'tip_turns': turns, **moved_by, **kind, **mount}


_MOUNT = ('tip_xyz', 'tip_rpy')  # where the tip sits on its force/torque sensor


def _heard_of(p: FingerArguments) -> tuple[tuple[str, str], ...]:
    """Return which topics of the sensor's node become which of the sensor's driver."""
    topic = p.sensor_topic
    remappings = {
        FORCE_TORQUE: ((WRENCH, topic),),
        CAMERA: ((IMAGE, topic), (COMPRESSED_IMAGE, f'{topic}/compressed')),
    }
    if not topic:
        return ()
    if p.sensor not in remappings:
        raise ValueError(f'argument sensor_topic: expected none for {p.sensor}, got {topic!r}')
    return remappings[p.sensor]


def _node(
    node: str,
    namespace: str,
    files: list[Sections],
    values: Mapping[str, Any],
    own: Mapping[str, Any] | None = None,
) -> Program:
    """Return a node of the package with its values; ValueError if it refuses one.

    It gets what the files say for it, of `values` what it declares, and all of its `own`.
    """
    kind = PARAMETERS[node]
    declared = {known.name for known in kind.declared()}
    full_name = '/'.join(('', *filter(None, namespace.split('/')), node))
    given: dict[str, Any] = {}
    for sections in files:
        for section, entries in sections.items():
            if matches(section, full_name):
                given |= entries
    given |= {name: value for name, value in values.items() if name in declared}
    given |= own or {}
    if node not in PLANTS:  # which make the simulated time
        given |= _time(values)
    try:
        for name in given:
            if similar := meant(name, declared) if name not in declared else '':
                raise ValueError(f'parameter {name}: unknown, did you mean {similar}?')
        kind.of(given)
    except ValueError as error:
        raise ValueError(f'{node}: {error}') from None
    return Program(OWN_PACKAGE, node, given)


def _shown(
    machine: Mapping[str, Any] | None, values: Mapping[str, Any], *, rviz: bool
) -> list[Program]:
    """Return what publishes the finger's description and frames, if it has joints, and RViz."""
    time = _time(values)
    shown = []
    if rviz:
        arguments = ['-d', str(config_file('demo.rviz'))]
        if machine is None:  # nothing publishes frames
            arguments += ['--fixed-frame', FINGER_DISK]
        shown.append(
            Program(RVIZ, RVIZ, time, tuple(arguments), OWN_TF, 'rviz:=false', only_shows=True)
        )
    if machine is not None:
        described = {'robot_description': robot_description(machine), **time}
        shown.append(Program(STATE_PUBLISHER, STATE_PUBLISHER, described, (), OWN_TF))
    return shown


def _page(namespace: str, files: list[Sections], values: Mapping[str, Any]) -> Program:
    """Return the page for browsers; ValueError if its library is missing."""
    if needed := missing_for_the_page():
        raise ValueError(f'{LIVE_PAGE} {needed}, or start without it: watch:=false')
    return replace(_node(LIVE_PAGE, namespace, files, values), only_shows=True)


def _time(values: Mapping[str, Any]) -> dict[str, Any]:
    """Return what tells a node which time to use."""
    return {'use_sim_time': True} if values.get('use_sim_time') else {}
