# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""When simulated time may go on."""

import math

ROUNDING = 1e-6  # by which a stamp may be off the number that it stands for [s]
LONGEST_LOOK = 0.01  # more wall time between two looks does not count [s]: nobody looked


class Pace:
    """Paces simulated time: no faster than asked, and never ahead of the loop it closes.

    Simulated time waits for the next command when it is due, and for a contact with the stamp of
    the last reading, because a driver that reads late would stamp it with a later time. If a servo
    moves the joints, it waits for the answer to the last joint states and the last command, too. If
    objects are placed, it waits for what a control period has decided, and stops when an object is
    due to be let go until that is said. So a loaded machine makes an experiment slower, not
    different. Time does not wait for the contact of a reading that is lost, reports no contact or
    is an outlier: none need follow. A contact may be stamped earlier than its reading by `lag`, as
    by a sensor node that filters. After `patience` of wall time it no longer waits for what is
    overdue, until that comes again: whoever sends it has gone. Time in which this process itself
    stood still does not count, since what is overdue may lie here unread.
    """

    def __init__(
        self, real_time_factor: float, control_period: float, patience: float, lag: float = 0.0
    ) -> None:
        # Simulated seconds a second, at the most; at most 1 until there are contacts and commands.
        self._factor = real_time_factor
        self._control_period = control_period  # simulated time between commands [s]
        self._patience = patience  # how long time stands for something overdue [s of wall time]
        self._lag = lag  # of a contact's stamp behind its reading [s]
        self._next_wall = -math.inf
        self._held = 0.0  # for how long time has stood still [s of wall time]
        self._looked = math.inf  # when it was last seen to stand still [s of wall time]
        self._command = math.nan  # not waited for
        self._contact = math.nan  # not waited for
        self._reading = math.nan
        self._contact_overdue = False
        self._dated_command = math.nan  # stamp of the last command, if it can be one [s]
        self._answered = math.nan, math.nan  # joint states and command [s]; not waited for
        self._decided = math.nan  # control period of the last decision [s]; not waited for
        self._release = math.nan  # when an object is let go [s]; not waited for

    @property
    def contact_overdue(self) -> bool:
        """Whether time stands because a reading has not become a contact."""
        return self._contact_overdue

    @property
    def commanded(self) -> bool:
        """Whether commands come in time."""
        return not math.isnan(self._command)

    def command(self, stamp: float, now: float) -> None:
        """Take note of a command.

        A stamp that cannot be that of the last tick is taken for `now`: its sender has another
        clock.
        """
        plausible = now - self._control_period <= stamp <= now
        self._command = stamp if plausible else now
        self._dated_command = stamp if plausible else math.nan

    def reading(self, now: float) -> None:
        """Take note that the sensor sent a reading from which a contact has to follow."""
        self._reading = now

    def contact(self, stamp: float) -> None:
        """Take note of a contact."""
        self._contact = stamp

    def answer(self, joint_states: float, command: float) -> None:
        """Take note that a servo has answered joint states and a command of these stamps [s]."""
        self._answered = joint_states, command

    def decision(self, stamp: float, let_go_in: float) -> None:
        """Take note of what a control period decided: when to let go, after it [s]; NaN if not."""
        self._decided = stamp
        if math.isfinite(let_go_in):
            self._release = stamp + let_go_in + ROUNDING

    def released(self) -> None:
        """Take note that the finger was told to let go."""
        self._release = math.nan

    def stop_before(self, now: float, time: float) -> float:
        """Return where time has to stop on its way to `time` [s], which it is itself if nowhere."""
        return self._release if now < self._release < time else time

    def may_reach(self, time: float, step: float, wall: float) -> bool:
        """Decide at the wall time `wall` [s] whether simulated time may step on to `time` [s]."""
        if wall < self._next_wall:
            return False
        due = self._command + self._control_period
        command_overdue = time > due + step / 2.0
        self._contact_overdue = self._contact + self._lag < self._reading - step / 2.0
        joint_states, command = self._answered
        answer_overdue = (
            joint_states < time - 1.5 * step or command < self._dated_command - step / 2.0
        )
        decision_overdue = self._decided < self._dated_command - step / 2.0 or time > self._release
        if command_overdue or self._contact_overdue or answer_overdue or decision_overdue:
            longest = max(LONGEST_LOOK, step / self._factor)
            self._held += min(max(wall - self._looked, 0.0), longest)
            self._looked = wall
            if self._held < self._patience:
                return False
            if command_overdue:
                self._command = math.nan
            if self._contact_overdue:
                self._contact = math.nan
            if answer_overdue:
                self._answered = math.nan, math.nan
            if decision_overdue:
                self._decided = self._release = math.nan
        self._held, self._looked = 0.0, math.inf
        self._contact_overdue = False
        looping = self.commanded and not math.isnan(self._contact)
        pause = step / (self._factor if looping else min(self._factor, 1.0))
        self._next_wall = max(self._next_wall + pause, wall)
        return True
