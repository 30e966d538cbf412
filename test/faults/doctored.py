# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Let the doctor look while a fault has stopped the finger, and see whether it names the fault.

    PYTHONPATH=test python -m faults.doctored [--only NAME …]

Goes through the rows of `NAMED`. Whether promises are held is the business of `python -m faults`.
"""

import argparse
import os
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import Any

from faults import FAULTS
from faults.bench import Bench
from faults.interrupt import interrupt_once
from faults.promise import Setup
from faults.table import Runner, start_bench
from tactile_push.doctor import RIGHT, Finding, findings
from tactile_push.doctor.looking import look
from tactile_push.interface import (
    CAMERA_SENSOR,
    COMMAND,
    CONTACT,
    CONTACT_GEOMETRY,
    FINGER_SERVO,
    JOINT_STATES,
    PUSH_CONTROLLER,
    SENSOR_DRIVER,
    SERVO_COMMANDS,
    TACTILE,
    WRENCH_SENSOR,
)

# What the doctor has to speak of while a fault lasts. A node that is gone leaves its topic behind.
NAMED = {
    **dict.fromkeys(('driver killed', 'driver stopped, continued'), TACTILE),
    **dict.fromkeys(('geometry killed', 'geometry stopped, continued'), CONTACT_GEOMETRY),
    **dict.fromkeys(
        (
            *('controller stopped, continued', 'controller killed', 'controller deactivated'),
            *('controller gets SIGINT', 'controller gets SIGTERM', 'workspace limit'),
            *('clock jumps 10 s ahead', 'clock jumps 10 s back', 'joint names misspelt'),
        ),
        PUSH_CONTROLLER,
    ),
    **dict.fromkeys(('plant stopped, continued', 'plant killed'), JOINT_STATES),
    **dict.fromkeys(
        (
            *('device unplugged', 'device silent', 'sentences cut off', '50 % of bytes corrupted'),
            *('line without line ends', 'wrong baud rate', 'sensor stuck, same number'),
        ),
        SENSOR_DRIVER,
    ),
    'readings out of plane': CONTACT_GEOMETRY,
    **dict.fromkeys(('contact not finite', 'contact in another frame'), CONTACT),
    **dict.fromkeys(('another command', 'two controllers'), COMMAND),
    **dict.fromkeys(('joint states silent', 'joint states late'), JOINT_STATES),
    **dict.fromkeys(
        ('joint states not finite', 'joint states of other joints', 'joint states missing'),
        CONTACT_GEOMETRY,
    ),
    **dict.fromkeys(
        (
            *('wrench silent', 'wrench not finite', 'wrench ten times a second'),
            *('wrench in another frame', 'wrench with the other sign'),
            'wrench of no single contact',
        ),
        WRENCH_SENSOR,
    ),
    **dict.fromkeys(
        (
            *('camera silent', 'camera sends black', 'lamp in the tip goes out'),
            *('camera is blinded', 'exposure changes', 'images of another size', 'camera hangs'),
        ),
        CAMERA_SENSOR,
    ),
    **dict.fromkeys(
        (
            *('servo deactivated', 'servo without joint states'),
            'servo with joint states that jump',
        ),
        FINGER_SERVO,
    ),
    'servo without commands': PUSH_CONTROLLER,
    'joint velocities of another': SERVO_COMMANDS,
}


class ExaminedBench(Bench):
    """A bench at which the doctor looks whenever the finger has stopped.

    Parameters
    ----------
    setup : Setup
        What is to run.
    found : list of Finding
        Gets what is wrong or missing by the last look.
    """

    def __init__(self, setup: Setup, found: list[Finding]) -> None:
        super().__init__(setup)
        self._found = found

    def stopped(self, since: float, patience: float = 3.0, **how: Any) -> None:
        """Measure how long it takes until the finger stands, and let the doctor look."""
        super().stopped(since, patience, **how)
        os.environ['ROS_DOMAIN_ID'] = str(self.nodes.domain)
        with ThreadPoolExecutor(1) as pool:
            future = pool.submit(look, self.finger.name('').rstrip('/'))
            self.observer.wait_for(future.done, 'the doctor to have looked')
        self._found[:] = [one for one in findings(future.result()) if one.verdict != RIGHT]


def examining(found: list[Finding]) -> Runner:
    """Return a runner at whose benches the doctor looks."""
    return Runner(partial(start_bench, make=partial(ExaminedBench, found=found)))


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the rows and print what the doctor says of each."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        '--only', nargs='+', metavar='NAME', help='the rows whose name contains one of these words'
    )
    only = parser.parse_args(arguments).only or ['']
    interrupt_once()
    missed, found = 0, list[Finding]()
    with examining(found) as runner:
        for fault in FAULTS:
            if fault.name not in NAMED or not any(word in fault.name for word in only):
                continue
            found.clear()
            outcome = runner.run(fault)
            named = NAMED[fault.name] in [one.subject for one in found]
            missed += not named
            words = [fault.name] if named else [fault.name, *outcome.broken]
            print(f'{"named" if named else "MISSED"}  {"; ".join(words)}')
            for one in found:
                print(f'        {one.verdict} {one.subject}: {one.words}', flush=True)
    return 1 if missed else 0


if __name__ == '__main__':
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(130)
