# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The control law (18) and the finger velocity for its push angle (Sections IV, V.A)."""

import math

from tactile_push.control.states import NO_REASON

AHEAD = math.pi / 2.0  # the push angle of a finger at rest: the belt alone pushes


def push_angle(
    phi: float,
    theta: float,
    theta_before: float,
    kp: float,
    kd: float,
    theta_desired: float,
    phi_min: float,
    phi_max: float,
) -> float:
    """Give the next push angle by (18).

    Parameters
    ----------
    phi : float
        Last push angle, phi(k-1) [rad].
    theta, theta_before : float
        Sensed angle of the pushed edge now and one period ago, theta(k) and theta(k-1) [rad].
    kp, kd : float
        Gains [rad/rad].
    theta_desired : float
        The edge's desired angle theta_d [rad].
    phi_min, phi_max : float
        Bounds of phi [rad].

    Returns
    -------
    float
        phi(k) [rad].
    """
    phi = phi + kp * (theta - theta_desired) + kd * (theta - theta_before)  # (18)
    return min(max(phi, phi_min), phi_max)


class PushLaw:
    """The law (18), one push angle a control period.

        phi(k) = phi(k-1) + kp [theta(k) - theta_d] + kd [theta(k) - theta(k-1)]

    It is the velocity form of a proportional-derivative law: phi itself is the memory. So the
    gains and theta_d may change at any time without a bump, and clamping phi leaves nothing that
    could wind up. The first reading after `reset` gives the initial phi: there is no theta(k-1)
    to differ from, hence no kick.

    Parameters
    ----------
    kp : float
        Proportional gain [rad/rad], 0 or more.
    kd : float
        Derivative gain [rad/rad], 0 or more.
    theta_desired : float
        The edge's desired angle theta_d [rad].
    phi_min, phi_max : float
        Bounds of phi [rad], 0 < phi_min <= pi/2 <= phi_max < pi; the paper uses 33 and 147
        degrees.
    """

    def __init__(
        self,
        kp: float,
        kd: float,
        theta_desired: float,
        phi_min: float = math.radians(33.0),
        phi_max: float = math.radians(147.0),
    ) -> None:
        self.kp = kp
        self.kd = kd
        self.theta_desired = theta_desired
        self.phi_min = phi_min
        self.phi_max = phi_max
        self.trim = 0.0  # added to theta_desired [rad], see `Steadying`
        self.phi = AHEAD
        #: Velocity of the finger across and along the belt in place of a push [m/s], while it is to
        #: be off the object; law (18) never has one. It is what the finger gets, as `phi` is.
        self.away: tuple[float, float] | None = None
        self._theta_before: float | None = None

    def reset(self, phi: float = AHEAD) -> None:
        """Forget the last reading and start over.

        Parameters
        ----------
        phi : float, optional
            Push angle to start from [rad]; straight ahead by default, which is where a finger
            at rest pushes.
        """
        self.phi = min(max(phi, self.phi_min), self.phi_max)
        self.away = None
        self._theta_before = None

    def update(self, theta: float) -> float:
        """Take a reading and give the push angle of the next period.

        Parameters
        ----------
        theta : float
            Sensed angle of the pushed edge [rad].

        Returns
        -------
        float
            phi [rad] in [phi_min, phi_max].

        Raises
        ------
        ValueError
            If theta is not finite.
        """
        if not math.isfinite(theta):
            raise ValueError(f'theta: expected a finite angle [rad], got {theta}')
        if self._theta_before is not None:
            self.phi = push_angle(
                self.phi,
                theta,
                self._theta_before,
                self.kp,
                self.kd,
                self.aim,
                self.phi_min,
                self.phi_max,
            )
        self._theta_before = theta
        return self.phi

    def go_on(self) -> None:
        """Take note of a period without a new reading: the push goes on as it was."""

    def pass_time(self, seconds: float) -> None:
        """Take note of the time since the last period; law (18) counts readings alone.

        Parameters
        ----------
        seconds : float
            The time [s].
        """

    def tune(self, kp: float, kd: float, theta_desired: float) -> None:
        """Take values that somebody has changed.

        Parameters
        ----------
        kp, kd, theta_desired : float
            Gains [rad/rad] and the edge's desired angle [rad].
        """
        self.kp, self.kd, self.theta_desired = kp, kd, theta_desired

    @property
    def rests(self) -> str:
        """Why the law does not want to push, one of `STOP_REASONS`; law (18) always does."""
        return NO_REASON

    @property
    def apart(self) -> bool:
        """Whether the finger is off the object on purpose and will touch it again."""
        return False

    @property
    def aim(self) -> float:
        """The angle that it steers to: theta_desired with its trim [rad]."""
        return self.theta_desired + self.trim

    @property
    def saturated(self) -> bool:
        """Whether phi is at one of its bounds."""
        return not self.phi_min < self.phi < self.phi_max


def finger_velocity(phi: float, belt_speed: float) -> float:
    """Give the finger's velocity across the belt, v_x = v_y / tan(phi) (Section V.A).

    Parameters
    ----------
    phi : float
        Push angle [rad], 0 < phi < pi.
    belt_speed : float
        Speed of the belt, v_y [m/s].

    Returns
    -------
    float
        v_x [m/s]; exactly 0 straight ahead.
    """
    return belt_speed * math.cos(phi) / math.sin(phi) if phi != AHEAD else 0.0


def motion_angle(v_x: float, belt_speed: float) -> float:
    """Give the push angle of a finger velocity, tan(phi) = v_y / v_x (Section V.A).

    Parameters
    ----------
    v_x : float
        Velocity across the belt [m/s].
    belt_speed : float
        Speed of the belt, v_y [m/s].

    Returns
    -------
    float
        phi [rad], in (0, pi); exactly `AHEAD` at rest.
    """
    return math.atan2(belt_speed, v_x) if v_x != 0.0 else AHEAD
