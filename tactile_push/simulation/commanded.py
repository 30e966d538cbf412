# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a finger makes of its commands: a velocity across the belt, or one of each joint."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from tactile_push.control import disk_velocity
from tactile_push.simulation.joint_rig import JointRig
from tactile_push.simulation.rig import Rig

if TYPE_CHECKING:
    from tactile_push.simulation.mujoco_joint_rig import MujocoJointRig
    from tactile_push.simulation.mujoco_rig import MujocoRig

# What a command was.
OBEYED, TOO_FAST = 'commands', 'commands too fast'
NOT_FINITE, OTHER_SIZE = 'commands not finite', 'commands of another size'


class CommandedVelocity:
    """A finger that follows a velocity, and stands when none comes any more.

    Parameters
    ----------
    rig, timeout : Rig or MujocoRig, float
        What it moves, and after how long without a command it stands [s].
    """

    def __init__(self, rig: 'Rig | MujocoRig', timeout: float) -> None:
        self._rig = rig
        self._timeout = timeout
        self._since: float | None = None  # when the last command came [s]
        self.v_x = 0.0  #: what is commanded across the belt [m/s]
        self.v_y = 0.0  #: the same along it, against its motion [m/s]

    @property
    def started(self) -> bool:
        """Whether the belt runs: from the first command on."""
        return self._since is not None

    def overdue(self, now: float) -> bool:
        """Return whether the last command is too old at a time [s]."""
        return self._since is not None and now - self._since >= self._timeout

    def take(self, v_x: float, v_y: float, fastest: float, now: float) -> str:
        """Take a command [m/s] at a time [s], bound both ways, and return what it was."""
        if not (math.isfinite(v_x) and math.isfinite(v_y)):
            self.expire()  # whoever sends this is not to be trusted with a moving finger
            return NOT_FINITE
        self.v_x, self.v_y = (min(max(one, -fastest), fastest) for one in (v_x, v_y))
        self._since = now
        return OBEYED if (self.v_x, self.v_y) == (v_x, v_y) else TOO_FAST

    def expire(self) -> None:
        """Stand, because the next command is overdue."""
        self.v_x = self.v_y = 0.0

    def move(self, duration: float, now: float, presses: bool = False) -> None:
        """Move for a while [s] up to a time [s].

        `presses` lets the belt run before the first command, too.
        """
        if self.overdue(now):
            self.expire()
        self._rig.step(self.v_x, duration, self.started or presses, self.v_y)


class CommandedJoints:
    """A finger that follows velocities of its joints until others come, as ros2_control does.

    Parameters
    ----------
    rig : JointRig or MujocoJointRig
        What it moves.
    """

    def __init__(self, rig: 'JointRig | MujocoJointRig') -> None:
        self._rig = rig
        self._rates: tuple[float, ...] = (0.0, 0.0)  # [rad/s]
        self.started = False  #: whether the belt runs: from the first motion or command on

    @property
    def v_x(self) -> float:
        """Velocity across the belt that is commanded [m/s]."""
        return self._velocity(self._rates)[0]

    def overdue(self, now: float) -> bool:
        """Return False: velocities stay in force."""
        return False

    def take(self, rates: Sequence[float], fastest: float) -> str:
        """Take velocities of the joints [rad/s], bound the disk's, and return what they were."""
        if len(rates) != len(self._rates):
            return OTHER_SIZE  # which a velocity controller ignores
        if not all(map(math.isfinite, rates)):
            self._rates = (0.0,) * len(rates)
            return NOT_FINITE
        self.started = self.started or any(rates)
        speed = math.hypot(*self._velocity(rates))
        share = min(1.0, fastest / speed) if speed else 1.0
        self._rates = tuple(share * rate for rate in rates)
        return OBEYED if share == 1.0 else TOO_FAST

    def expire(self) -> None:
        """Go on: velocities stay in force."""

    def move(self, duration: float, now: float, presses: bool = False) -> None:
        """Move for a while [s]; `presses` lets the belt run before the first command, too."""
        self._rig.drive(self._rates, duration, self.started or presses)

    def _velocity(self, rates: Sequence[float]) -> tuple[float, float]:
        return disk_velocity(self._rig.config.finger.levers(self._rig.joints[:2]), rates)
