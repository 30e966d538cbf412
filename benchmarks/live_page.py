# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Whether the live page stays smooth and its memory flat for ten minutes: one row a minute.

    python benchmarks/live_page.py [--minutes M] [--rate HZ]

A real `live_page` node hears every topic that it shows at 50 Hz, and a headless Chromium shows its
page. Something has grown if it is never as small in the second half as at the most in the first.
Needs the extras ros, test and watch.
"""

import argparse
import math
import shutil
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
from playwright.sync_api import CDPSession, Page, sync_playwright
from sensor_msgs.msg import JointState

from tactile_push.interface import (
    CONTACT,
    CONTROLLER_STATE,
    LIVE_PAGE,
    OBJECT_POSE,
    SENSING_STATE,
    TOPICS,
    TRUE_POSE,
    TRUE_STATE,
)
from tactile_push.testing import NodeProcesses, Observer

BROWSERS = ('chromium', 'chromium-browser', 'google-chrome')
JOINTS = (CONTROLLER_STATE, SENSING_STATE, TRUE_STATE)
POSES = {CONTACT: PoseStamped, TRUE_POSE: PoseStamped, OBJECT_POSE: PoseWithCovarianceStamped}
LATE = 200.0  # between two pictures, after which a person sees a jerk [ms]; picked
# Counts pictures, and those that came late, by the time that the page shows.
WATCH = f"""() => {{
  window.seen = {{ pictures: 0, late: 0, longest: 0 }};
  let before = performance.now();
  new MutationObserver(() => {{
    const now = performance.now();
    window.seen.pictures += 1;
    window.seen.late += now - before > {LATE};
    window.seen.longest = Math.max(window.seen.longest, now - before);
    before = now;
  }}).observe(document.getElementById('at-time'), {{ childList: true }});
}}"""
TAKE = """() => {
  const seen = { ...window.seen };
  Object.assign(window.seen, { pictures: 0, late: 0, longest: 0 });
  return seen;
}"""


class Feeder:
    """Publishes on every topic that the page shows, as often as a second has turns."""

    def __init__(self, observer: Observer) -> None:
        make = observer.node.create_publisher
        self._joints = {topic: make(JointState, topic, 10) for topic in JOINTS}
        self._poses = {topic: (kind, make(kind, topic, 10)) for topic, kind in POSES.items()}

    def publish(self, t: float) -> None:
        """Publish what an object does that turns to and fro; the finger stops now and then."""
        theta, stopped = 0.3 * math.sin(t), t % 10.0 < 0.5
        for topic, publisher in self._joints.items():
            values = {name: 0.001 * math.sin(t + i) for i, name in enumerate(_names(topic))}
            values |= {'theta': theta, 'phi': 1.6 + theta / 3.0, 'psi': 1.57, 'contradiction': 0.0}
            values |= {'state': 3.0 if stopped else 2.0, 'stop_reason': float(stopped)}
            taken = {name: values[name] for name in _names(topic)}
            publisher.publish(JointState(name=list(taken), position=list(taken.values())))
        for kind, publisher in self._poses.values():
            publisher.publish(_pose(kind, theta))


def _names(topic: str) -> tuple[str, ...]:
    return TOPICS[topic].field_names


def _pose(kind: Any, theta: float) -> Any:
    message = kind()
    pose = getattr(message.pose, 'pose', message.pose)
    pose.position.x, pose.position.y = -0.037 * math.sin(theta), 0.037 * math.cos(theta)
    pose.orientation.z, pose.orientation.w = math.sin(theta / 2.0), math.cos(theta / 2.0)
    return message


def _measure(page: Page, session: CDPSession, pid: int) -> dict[str, float]:
    session.send('HeapProfiler.collectGarbage')
    metrics = {m['name']: m['value'] for m in session.send('Performance.getMetrics')['metrics']}
    status = Path(f'/proc/{pid}/status').read_text()
    return {
        'heap': metrics['JSHeapUsedSize'] / 1e6,
        'elements': metrics['Nodes'],
        'busy': metrics['TaskDuration'],
        'node': int(status.split('VmRSS:')[1].split()[0]) / 1e3,
        **page.evaluate(TAKE),
    }


def main() -> int:
    """Run for the minutes that are asked for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--minutes', type=int, default=10, metavar='M', help='default: 10')
    parser.add_argument('--rate', type=float, default=50.0, metavar='HZ', help='default: 50')
    options = parser.parse_args()
    executable = next(filter(None, map(shutil.which, BROWSERS)), None)
    if executable is None:
        print(f'live_page: no browser: install {" or ".join(BROWSERS)}', file=sys.stderr)
        return 2
    rows = []
    with (
        tempfile.TemporaryDirectory() as folder,
        NodeProcesses(Path(folder)) as nodes,
        Observer(nodes.domain) as observer,
        sync_playwright() as playwright,
    ):
        node = nodes.start(LIVE_PAGE, {'port': 0})
        log = nodes.log(LIVE_PAGE)
        observer.wait_for(lambda: 'http:' in log.read_text(), 'the address')
        address = next(word for word in log.read_text().split() if word.startswith('http:'))
        feeder = Feeder(observer)
        browser = playwright.chromium.launch(executable_path=executable, args=['--no-sandbox'])
        page = browser.new_page()
        page.goto(address)
        while not page.locator('#at-time').count():
            page.wait_for_timeout(50)
        page.evaluate(WATCH)
        session = page.context.new_cdp_session(page)
        session.send('Performance.enable')
        print('minute  pictures/s  late  longest [ms]  busy [%]  heap [MB]  elements  node [MB]')
        began, turn, busy = time.monotonic(), 0, 0.0
        for minute in range(1, options.minutes + 1):
            while time.monotonic() - began < 60.0 * minute:
                feeder.publish(turn / options.rate)
                turn += 1
                time.sleep(max(0.0, began + turn / options.rate - time.monotonic()))
            row = _measure(page, session, node.pid)
            rows.append(row)
            print(
                f'{minute:6}{row["pictures"] / 60.0:12.1f}{row["late"]:6}{row["longest"]:14.0f}'
                f'{(row["busy"] - busy) / 0.6:10.1f}{row["heap"]:11.2f}{row["elements"]:10.0f}'
                f'{row["node"]:11.1f}',
                flush=True,
            )
            busy = row['busy']
        browser.close()
    first, second = rows[: len(rows) // 2], rows[len(rows) // 2 :]
    grown = [
        what
        for what in ('heap', 'elements', 'node')
        if first and min(row[what] for row in second) > max(row[what] for row in first)
    ]
    print(f'grown: {", ".join(grown)}' if grown else 'nothing has grown')
    return 1 if grown else 0


if __name__ == '__main__':
    sys.exit(main())
