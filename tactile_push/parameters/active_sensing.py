# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of `active_sensing`, and the estimator that they describe."""

import math
import typing
from dataclasses import dataclass

from tactile_push.control import Limits
from tactile_push.interface import POINTS, SILENT, WITHOUT_PSI
from tactile_push.parameters import shared
from tactile_push.parameters.parameter import NodeParameters, parameter

if typing.TYPE_CHECKING:
    from tactile_push.estimation import ActiveSensing

TINY = 1e-12  # what is shorter is no edge [m]


@dataclass(frozen=True)
class ActiveSensingParameters(NodeParameters):
    """What is known of the object beforehand, and of the rig."""

    # fmt: off
    vertices: list[float] = shared.vertices
    edge: int = parameter(-1, '',
        'the pushed edge if it is known, 0 from the first corner to the second; -1 if not',
        -1, 1000, read_only=True)
    disk_radius: float = parameter(0.0, 'm',
        'radius of a round object, which has no vertices; 0 if it is not round',
        0.0, 1.0, read_only=True)
    l_share: float = parameter(0.085, '',
        'standard deviation of the distance from an edge to the centre of mass, as a share of it',
        0.0, 0.3, read_only=True)
    c_min: float = parameter(0.005, 'm',
        'least c = m_max / f_max that is possible', 1e-4, 1.0, read_only=True)
    c_max: float = parameter(0.036, 'm',
        'largest c = m_max / f_max that is possible', 1e-4, 1.0, read_only=True)
    mu_c_min: float = parameter(0.0, '',
        'least friction between finger and object that is possible', 0.0, read_only=True)
    mu_c_max: float = parameter(math.inf, '',
        'largest friction between finger and object that is possible; may be .inf',
        0.0, read_only=True)
    tilt_max: float = parameter(0.008, 'm',
        'greatest mu_s times height of the contact above the belt that is possible; 0 for a push '
        'at the belt',
        0.0, 0.1, read_only=True)
    noise: float = parameter(0.0035, 'rad',
        'standard deviation of the readings of theta', 1e-5, 0.5, read_only=True)
    finger_radius: float = shared.finger_radius
    commanded_point: str = shared.commanded_point
    without_psi: str = parameter(SILENT, '',
        'while the direction of the finger tip is not known, or the joints tell of another motion '
        'than was commanded: silent says nothing, '
        'widen takes each reading for the first one, straight takes the tip for one that does not '
        'turn', choices=WITHOUT_PSI, read_only=True)
    finger_lag: float = shared.finger_lag
    finger_delay: float = parameter(0.0, 's',
        'time before a command has any effect on the finger', 0.0, 10.0, read_only=True)
    belt_speed: float = shared.belt_speed
    contact_timeout: float = parameter(Limits().contact_timeout, 's',
        'after longer without a reading or a control period the estimate starts over, and a '
        'reading that is stamped further ahead does not count',
        0.01, 10.0, read_only=True)
    # fmt: on

    @property
    def corners(self) -> list[tuple[float, float]]:
        """Corners of the outline about the centre of mass [m]."""
        return list(zip(self.vertices[::2], self.vertices[1::2], strict=False))

    @property
    def distances(self) -> list[float]:
        """Each l that the pushed edge may have, or the radius of a disk [m].

        Of an outline that is none the list may be empty and its numbers may not be positive.
        """
        if self.disk_radius > 0.0:
            return [self.disk_radius]
        corners = self.corners
        found = [
            (x * next_y - next_x * y) / max(math.hypot(next_x - x, next_y - y), TINY)
            for (x, y), (next_x, next_y) in zip(corners, corners[1:] + corners[:1], strict=True)
        ]
        return found if self.edge < 0 else found[self.edge : self.edge + 1]


def compile_sensing(p: ActiveSensingParameters) -> None:
    """Compile now, or load, what active sensing would compile at its first readings."""
    sensing = make_sensing(p)
    for tick in range(2):
        sensing.tick(0.1 * tick, 0.0, 0.0, 0.0)


def make_sensing(p: ActiveSensingParameters) -> 'ActiveSensing':
    """Make active sensing that knows nothing yet.

    Raises
    ------
    ValueError
        If the outline is none or far too large, has no such edge, or if a range is empty.
    """
    from tactile_push.estimation import (  # which loads the compiler
        ActiveSensing,
        DiskEstimator,
        FingerMotion,
        ObjectEstimator,
        edges_of,
    )
    from tactile_push.mechanics import Outline
    from tactile_push.mechanics.size import check_metres

    for name in ('c', 'mu_c'):
        low, high = getattr(p, f'{name}_min'), getattr(p, f'{name}_max')
        if not (low < high or (name == 'mu_c' and low == high)):
            raise ValueError(f'{name}_max: expected more than {name}_min = {low:g}, got {high:g}')
    estimator: ObjectEstimator | DiskEstimator
    if p.disk_radius > 0.0:
        estimator = DiskEstimator(p.disk_radius, p.noise, radius=p.finger_radius, tilt=p.tilt_max)
    else:
        numbers = len(p.vertices)
        if numbers % 2 or numbers < 6:
            raise ValueError(
                f'vertices: expected x and y of three corners or more, got {numbers} numbers'
            )
        edges = edges_of(p.corners)
        check_metres('vertices', Outline.polygon(p.corners))
        if p.edge >= len(edges):
            raise ValueError(f'edge: expected -1 to {len(edges) - 1}, got {p.edge}')
        if p.edge >= 0:
            edges = edges[p.edge : p.edge + 1]
        estimator = ObjectEstimator(
            edges,
            p.noise,
            c=(p.c_min, p.c_max),
            mu_c=(p.mu_c_min, p.mu_c_max),
            l_share=p.l_share,
            radius=p.finger_radius,
            tilt=p.tilt_max,
        )
    motion = FingerMotion(p.finger_lag, p.finger_delay)
    return ActiveSensing(
        *(estimator, motion, p.belt_speed, p.contact_timeout),
        point=POINTS.index(p.commanded_point),
        radius=p.finger_radius,
        without_psi=p.without_psi,
    )
