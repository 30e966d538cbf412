# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Pushes in a bag of the package, in which something else than the finger says where the object is.

On the belt the finger goes ahead as fast as the belt moves. While it pushes, the way is cut into
pushes of `CUT`.
"""

from collections.abc import Iterator
from itertools import groupby

import numpy as np

from tactile_push.bags import BagError, BagReader
from tactile_push.control import PUSHING, STATES
from tactile_push.fingers import definition_trouble, fingers_in
from tactile_push.identification.records import Push, Pushes, cut
from tactile_push.interface import (
    CONTACT_GEOMETRY,
    CONTROLLER_STATE,
    FINGER_BASE,
    FINGER_DISK,
    JOINT_STATES,
    POSE_TYPE,
    PUSH_CONTROLLER,
    TRUE_POSE,
    UNCERTAIN_POSE_TYPE,
    node_in,
)
from tactile_push.mechanics import Pose
from tactile_push.mechanics.compiled import Array
from tactile_push.parameters import ContactGeometryParameters, PushControllerParameters
from tactile_push.parameters.push_controller import make_finger
from tactile_push.parameters.recorded import recorded_parameters
from tactile_push.report.columns import Columns, Table, positions, read_tables, time_of
from tactile_push.simulation import ObjectFile

GAP = 0.5  # between two poses, after which another push begins [s]
NOTHING = f'nothing to identify, expected messages on {CONTROLLER_STATE}'
FRAMES = FINGER_DISK, FINGER_BASE


def pushes_in_bag(bag: BagReader, known: ObjectFile, topic: str | None = None) -> Pushes:
    """Read pushes of a bag.

    Parameters
    ----------
    bag : BagReader
        The bag. Of several fingers that counts in whose namespace the topic is.
    known : ObjectFile
        The object. The origin of its outline is where the poses are those of.
    topic : str, optional
        Full name of a topic of poses of the object, in `finger_disk` or `finger_base`; by default
        that of the simulator's.

    Returns
    -------
    Pushes
        The pushes.

    Raises
    ------
    BagError
        If the bag cannot be read or says nothing of a controller.
    ValueError
        If it has no such poses, or several fingers and the topic is not that of one of them.
    """
    found = fingers_in(bag, [CONTROLLER_STATE], [CONTROLLER_STATE], NOTHING)
    namespace = _finger_of(bag, [*found], topic)
    topic = topic or f'{namespace}/{TRUE_POSE}'
    frame = _frame(bag, topic)
    tables, _ = read_tables(bag, {f'{namespace}/{CONTROLLER_STATE}': CONTROLLER_STATE, topic: ''})
    ticks, poses = tables[CONTROLLER_STATE], tables['']
    recorded = recorded_parameters(bag.notes)[0] or {}
    control = PushControllerParameters.of(recorded.get(node_in(namespace, PUSH_CONTROLLER), {}))
    geometry = ContactGeometryParameters.of(recorded.get(node_in(namespace, CONTACT_GEOMETRY), {}))
    time = poses['time']
    x, psi = (_at(ticks, name, time) for name in ('finger_x', 'psi'))
    y = np.zeros_like(x)
    origin = np.stack([x, y], axis=-1)  # of the frame of the poses
    if frame == FINGER_BASE:
        x, y = _finger(bag, f'{namespace}/{JOINT_STATES}', control, time)
        origin = np.zeros_like(origin)
    travel = control.belt_speed * time
    tip = np.stack([x, y + travel], axis=-1)
    place = np.stack([poses['x'], poses['y'] + travel], axis=-1) + origin
    pushes: list[Push] = []
    for part in _stretches(ticks, time, tip + place):
        pushes += cut(
            f'{bag.path}: {time[part[0]]:.1f} s',
            [(float(a), float(b)) for a, b in tip[part]],
            [Pose(*map(float, (*place[k], poses['yaw'][k]))) for k in part],
            geometry.finger_radius,
            np.nan_to_num(psi[part]).tolist(),
        )
    return Pushes(known.outline, tuple(pushes), known.support)


def _frame(bag: BagReader, topic: str) -> str:
    """Return the frame of poses, all of which must be in it."""
    types = POSE_TYPE, UNCERTAIN_POSE_TYPE
    if topic not in bag.topics or bag.topics[topic].type_name not in types:
        raise ValueError(f'{bag.path}: expected poses of the object on {topic}, got none')
    if trouble := definition_trouble(bag, topic):
        raise BagError(f'{bag.path}: {trouble}')
    frames = {bag.decode(message).header.frame_id for message in bag.messages([topic])}
    if len(frames) != 1 or not frames <= set(FRAMES):
        raise ValueError(
            f'{bag.path}: expected poses on {topic} in {" or ".join(FRAMES)}, got '
            f'{", ".join(map(repr, sorted(frames))) or "none"}'
        )
    return str(frames.pop())


def _at(ticks: Table, name: str, time: Array) -> Array:
    """Return where the finger was, by control periods that tell how old that is."""
    if name not in ticks:
        return np.full_like(time, np.nan)
    when = ticks['time'] - ticks.get('finger_age', np.zeros_like(ticks['time']))
    there = np.isfinite(ticks[name] + when)
    if not there.any():
        return np.full_like(time, np.nan)
    return np.interp(time, when[there], ticks[name][there], np.nan, np.nan)


def _finger(
    bag: BagReader, topic: str, control: PushControllerParameters, time: Array
) -> tuple[Array, Array]:
    """Return the disk's centre in `finger_base`, by the joints."""
    finger, names, columns = make_finger(control), control.joint_names[:2], Columns()
    for message in bag.messages([topic]):
        content = bag.decode(message)
        joints = positions(content, set(names))
        if len(joints) == len(names):
            pose = finger.forward(*(joints[name] for name in names))
            at = time_of(content.header.stamp, message.log_time, bag.start_time)
            columns.add(at, {'x': pose.x, 'y': pose.y})
    table = columns.table()
    if not len(table['time']):
        raise ValueError(f'{bag.path}: expected angles of {", ".join(names)} on {topic}, got none')
    x, y = (np.interp(time, table['time'], table[axis], np.nan, np.nan) for axis in 'xy')
    return x, y


def _finger_of(bag: BagReader, namespaces: list[str], topic: str | None) -> str:
    """Return the namespace of the finger whose object's poses are on a topic."""
    if len(namespaces) == 1:
        return namespaces[0]
    inside = [space for space in namespaces if topic and topic.startswith(f'{space}/')]
    if not inside:
        fingers = ' and '.join(space or '/' for space in namespaces)
        raise ValueError(
            f'{bag.path}: expected poses in the namespace of a finger, {fingers}, got '
            f'{topic or "no topic"}'
        )
    return max(inside, key=len)


def _stretches(ticks: Table, time: Array, places: Array) -> Iterator[list[int]]:
    """Yield indices of poses during each stretch of pushing."""
    last = np.searchsorted(ticks['time'], time, side='right') - 1
    pushing = (last >= 0) & (ticks['state'][last] == STATES.index(PUSHING))
    pushing &= np.isfinite(places).all(axis=1)
    parted = np.cumsum(np.diff(time, prepend=time[:1]) > GAP)
    for (goes_on, _), group in groupby(
        range(len(time)), lambda k: (bool(pushing[k]), int(parted[k]))
    ):
        if goes_on:
            yield list(group)
