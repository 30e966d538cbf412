# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How fast the report of ten minutes opens in a browser: `make bench`."""

import math
import shutil
import statistics

import numpy as np
import pytest
from playwright.sync_api import sync_playwright

from tactile_push.report import report_html
from tactile_push.report.data import Episode, Run, Scene, Series

SECONDS, TICKS, READINGS = 600.0, 10.0, 100.0  # of the run [s], rates [Hz]
LOADS = 5
GOAL = 2.0  # from the navigation until all is drawn [s]


def ten_minutes():
    """Make a run as long as that, with noise on every line and an episode every five seconds."""
    random = np.random.default_rng(1)

    def series(rate, level, noise):
        time = np.arange(0.0, SECONDS, 1.0 / rate)
        return Series(time, level + 0.1 * np.sin(time) + random.normal(0.0, noise, len(time)))

    slow = {'theta': 0.1, 'phi': 1.5, 'theta_desired': -0.2, 'v_x': 0.001, 'd': 0.001}
    slow |= {'d_lower': 0.0, 'd_upper': 0.002, 'silence': 0.02, 'finger_x': 0.0, 'state': 0.0}
    fast = {'v_x_true': 0.001, 'd_true': 0.001, 'interval': 0.01, 'belt_travel': 0.0}
    fast |= {'object_x': 0.0, 'object_y': 0.04, 'object_angle': 0.0}
    return Run(
        name='ten minutes',
        duration=SECONDS,
        series={name: series(TICKS, level, 0.01) for name, level in slow.items()}
        | {name: series(READINGS, level, 0.001) for name, level in fast.items()},
        states=['pushing'],
        episodes=[
            Episode(f'node {k % 5}', 5.0 * k, 5.0 * k + 2.0, 'some refused', 'warning')
            for k in range(120)
        ],
        scene=Scene(0.0135, [(-0.02, -0.02), (0.02, -0.02), (0.02, 0.02)], mu_c=math.inf),
    )


def test_page_of_ten_minutes_opens_at_once(tmp_path):
    """Open it again and again, each time without a cache."""
    executable = shutil.which('chromium')
    if executable is None:
        pytest.skip('no browser: chromium is not installed')
    file = tmp_path / 'page.html'
    file.write_text(report_html(ten_minutes()), encoding='utf-8')
    times = []
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=executable, args=['--no-sandbox', '--disable-gpu']
        )
        for _ in range(LOADS):
            page = browser.new_context().new_page()
            page.goto(file.as_uri())
            ready = "performance.getEntriesByName('ready')"
            while not page.evaluate(f'{ready}.length'):
                page.wait_for_timeout(20)
            times.append(page.evaluate(f'{ready}[0].startTime') / 1e3)
            page.context.close()
        browser.close()
    median = statistics.median(times)
    print(
        f'\n    {file.stat().st_size / 1e6:.1f} MB; drawn after {min(times):.2f} to '
        f'{max(times):.2f} s, median {median:.2f} s, goal {GOAL:g} s'
    )
    assert median < GOAL
