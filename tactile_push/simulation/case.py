# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What `tactile_push simulate` does: one rollout of an object by name or from a file."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tactile_push.control import PushLaw, settle_step
from tactile_push.mechanics import MODES, Outline, Slider, Support
from tactile_push.simulation import RigConfig, Rollout, read_object, read_support, rollout

BAND = math.radians(3.0)  # within it of theta_d theta counts as settled, V.C
BLOCK, DISK = 'block', 'disk'
BLOCK_D = -0.006  # fig. 8


@dataclass(frozen=True)
class Simulation:
    """A simulated run and its case.

    Parameters
    ----------
    run : Rollout
        What happened.
    config : RigConfig
        The object and where it started.
    theta_desired : float
        Desired angle of the edge [rad].
    settle_step : int or None
        First step from which theta stays within 3 degrees of it.
    """

    run: Rollout
    config: RigConfig
    theta_desired: float
    settle_step: int | None

    def as_json(self) -> dict[str, Any]:
        """Give the run as JSON has it, in SI units.

        Returns
        -------
        dict
            Arrays `theta`, `phi`, `d`, `x`, `y`, `mode`, a value for the start of every step, and
            `c`, `settle_step`, `end`.
        """
        return {
            'theta': self.run.theta.tolist(),
            'phi': self.run.phi.tolist(),
            'd': self.run.d.tolist(),
            'x': self.run.x.tolist(),
            'y': self.run.y.tolist(),
            'mode': [MODES[mode] for mode in self.run.mode],
            'c': self.config.slider.c,
            'settle_step': self.settle_step,
            'end': self.run.end,
        }


def simulate(
    thing: str,
    support: str,
    *,
    exact: bool,
    mu_c: float,
    theta: float,
    d: float | None,
    phi: float,
    theta_desired: float,
    kp: float,
    kd: float,
    steps: int,
    open_loop: bool,
) -> Simulation:
    """Simulate a run.

    Parameters
    ----------
    thing : str
        'block', 'disk' or the path of an object's file.
    support : str
        'corners', 'uniform', 'circle:RADIUS_M', 'rim' or the path of a support's file.
    exact : bool
        Whether the limit surface is the exact one of the support instead of the ellipsoid.
    mu_c : float
        Coefficient of friction between finger and object, 0 to infinity.
    theta : float
        Angle of the pushed edge at the start [rad].
    d : float or None
        Contact along the edge at the start [m]; None for that of fig. 8 on the block, and the one
        with the smallest d on other objects.
    phi : float
        First push angle [rad].
    theta_desired : float
        Desired angle of the edge [rad].
    kp, kd : float
        Gains of the law [rad/rad].
    steps : int
        Number of control periods.
    open_loop : bool
        Whether to push at `phi` all the time instead.

    Returns
    -------
    Simulation
        The run.

    Raises
    ------
    OSError
        If a file cannot be read.
    ValueError
        If something is not as expected; the message names it.
    """
    outline, centre_of_mass = _outline(thing)
    slider = Slider.on(
        outline,
        _support(support, outline, centre_of_mass),
        exact=exact,
        centre_of_mass=centre_of_mass,
    )
    if d is None and thing == BLOCK:
        d = BLOCK_D
    config = RigConfig(slider, mu_c, theta, d)
    for name, gain in (('kp', kp), ('kd', kd)):
        if not (math.isfinite(gain) and gain >= 0.0):
            raise ValueError(f'{name}: expected a gain of 0 or more, got {gain}')
    if not math.isfinite(theta_desired):
        raise ValueError(f'theta_desired: expected a finite angle [rad], got {theta_desired}')
    law = PushLaw(kp, kd, theta_desired)
    if not open_loop and not law.phi_min <= phi <= law.phi_max:
        raise ValueError(
            f'phi: expected {law.phi_min} to {law.phi_max} rad, the bounds of the law, got {phi}'
        )
    law.reset(phi)
    run = rollout(config, phi if open_loop else law, steps)
    settled = settle_step(run.theta, theta_desired, BAND)
    return Simulation(run, config, theta_desired, settled if run.end == 'done' else None)


def summary(simulation: Simulation) -> str:
    """Say in a few lines what happened.

    Parameters
    ----------
    simulation : Simulation
        The run.

    Returns
    -------
    str
        Lines for people, in degrees and millimetres.
    """
    run, steps = simulation.run, len(simulation.run.theta) - 1
    settled = simulation.settle_step
    wanted = f'{math.degrees(BAND):.0f}° of {math.degrees(simulation.theta_desired):g}°'
    counts = {name: int((run.mode[:steps] == mode).sum()) for mode, name in enumerate(MODES)}
    modes = ', '.join(f'{name} {count}' for name, count in counts.items() if count)
    return '\n'.join(
        [
            f'c          {1000.0 * simulation.config.slider.c:.2f} mm',
            f'steps      {steps} ({modes})' if modes else f'steps      {steps}',
            f'settled    {"never" if settled is None else f"step {settled}"}, within {wanted}',
            f'theta      {math.degrees(run.theta[0]):.2f}° -> {math.degrees(run.theta[-1]):.2f}°',
            f'phi        {math.degrees(run.phi[0]):.2f}° -> {math.degrees(run.phi[-1]):.2f}°',
            f'd          {1000.0 * run.d[0]:.3f} mm -> {1000.0 * run.d[-1]:.3f} mm',
        ]
    )


@contextmanager
def naming(option: str, file: object) -> Iterator[None]:
    """Turn an error of the system into a ValueError that names option and file.

    Parameters
    ----------
    option : str
        The option of the command.
    file : object
        What it names.

    Yields
    ------
    None
        Once.

    Raises
    ------
    ValueError
        If a file cannot be read or written.
    """
    try:
        yield
    except OSError as error:
        raise ValueError(f'{option}: {file}: {error.strerror}') from None


def _outline(thing: str) -> tuple[Outline, tuple[float, float] | None]:
    if thing == BLOCK:
        return Outline.rectangle(0.05, 0.0475), None
    if thing == DISK:
        return Outline.circle(0.0285), None
    with naming('--object', thing):
        return read_object(Path(thing))


def _support(name: str, outline: Outline, centre_of_mass: tuple[float, float] | None) -> Support:
    if name == 'corners':
        return Support.corners(outline)
    if name == 'uniform':
        return Support.uniform(outline)
    if name == 'rim':
        return Support.rim(outline)
    if name.startswith('circle:'):
        try:
            radius = float(name.removeprefix('circle:'))
        except ValueError:
            raise ValueError(f'support: expected circle:RADIUS_M, got {name}') from None
        centre = centre_of_mass or Support.uniform(outline).centre
        support = Support.circle(radius, *centre)
        rim = Outline.circle(radius).points(radius / 16.0) + centre
        if not outline.contains(rim, 1e-9 * outline.length).all():
            raise ValueError(f'support: expected a circle under the object, got {name}')
        return support
    with naming('--support', name):
        return read_support(Path(name))
