# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The live page in a real browser: what it shows, how it comes back, that it stays as it is."""

import contextlib
import json
import math
import re
import signal
import time

import pytest
from geometry_msgs.msg import PoseStamped
from sensor_msgs.msg import JointState

pytest.importorskip('aiohttp', reason="pip install 'tactile_push[watch]'")

from support.browser import DESKTOP, PHONE, wait_for
from tactile_push.interface import CONTROLLER_STATE, OBJECT_POSE, SENSING_STATE, TRUE_POSE
from tactile_push.testing import NodeProcesses, Observer
from tactile_push.watching.live import RATE, Live
from tactile_push.watching.page import live_page
from tactile_push.watching.server import Server

R = 0.0135  # of the finger [m]
THETA, PHI = math.radians(20.0), math.radians(100.0)
ESTIMATE = (0.001, 0.036)  # of the centre of mass [m]
# Of a canvas as a compressed picture: the less there is in it, the smaller.
PICTURE_SIZE = "((n) => document.querySelectorAll('canvas')[n].toDataURL().length)"
STOP = 'controller: stopped: contact silent'
D = {'d': 0.001, 'd_lower': -0.001, 'd_upper': 0.004, 'd_least': -0.02, 'd_most': 0.02}


class Fed:
    """A page's server that is fed without nodes, as fast as it is told."""

    def __init__(self, port=0, history=10.0):
        self._frames = 0
        self.live = Live(history)
        hello = lambda: json.dumps(self.live.hello())  # noqa: E731
        self.server = Server('127.0.0.1', port, *live_page('/left'), hello)
        self.scene([])

    def scene(self, outline):
        """Post an object."""
        scene = {'radius': 1e3 * R, 'outline': outline, 'mu_c': None}
        self.server.post('scene', json.dumps({'scene': scene}))

    def frame(self, theta=THETA, **tick):
        """Post one frame and, if they have changed, the events."""
        now = self._frames / RATE
        self._frames += 1
        pushing = {'theta': theta, 'phi': PHI, 'v_x': 0.001 * math.sin(now), 'silence': 0.02}
        self.live.take(now, CONTROLLER_STATE, pushing | {'state': 2.0, 'stop_reason': 0.0} | tick)
        self.live.take(now, SENSING_STATE, D)
        self.live.take(now, OBJECT_POSE, dict(zip('xy', ESTIMATE, strict=True)) | {'yaw': theta})
        self.server.post('frame', json.dumps(self.live.frame(now)))
        self.server.post('events', json.dumps(self.live.events(now)[1]))
        return f'{now:.2f} s'


@pytest.fixture
def fed():
    fed = Fed()
    yield fed
    fed.server.close()


@pytest.fixture
def opened(browser):
    """Return a function that opens a page; of what it says in vain there must be nothing."""
    contexts, complaints = [], []

    def open_page(address, viewport=DESKTOP, **options):
        contexts.append(browser.new_context(viewport=viewport, **options))
        page = contexts[-1].new_page()
        page.on('console', lambda message: complaints.append(message.text))
        page.on('pageerror', lambda error: complaints.append(str(error)))
        page.goto(address)
        wait_for(page, "performance.getEntriesByName('ready').length > 0")
        return page

    yield open_page
    for context in contexts:
        context.close()
    refused = 'net::ERR_CONNECTION_REFUSED'  # which the browser says of a server that is gone
    assert [text for text in complaints if refused not in text] == []


def joints(**values):
    return JointState(name=list(values), position=[float(value) for value in values.values()])


def coordinates(page, selector, *names):
    return [float(page.locator(selector).get_attribute(name)) for name in names]


def text_is(name, text):
    """Return the condition that an element has a text."""
    return f'document.getElementById({json.dumps(name)}).textContent === {json.dumps(text)}'


def lasted(page, what):
    """Return when an event ended, by the table of events, and how often it began."""
    rows = [row.split('\t') for row in page.locator('#events tr').all_inner_texts()]
    return {row[0]: (row[3], row[1]) for row in rows}[what]


def test_page_shows_what_real_nodes_say_and_a_stop_when_it_happens(
    nodes: NodeProcesses, observer: Observer, opened
):
    process = nodes.start('live_page', {'port': 0})
    nodes.start('active_sensing')  # which knows the block
    log = nodes.log('live_page')
    observer.wait_for(lambda: 'http:' in log.read_text(), 'the address')
    (address,) = re.findall(r'http:\S+', log.read_text())
    state = observer.node.create_publisher(JointState, CONTROLLER_STATE, 10)
    pose = observer.node.create_publisher(PoseStamped, TRUE_POSE, 10)
    truth = PoseStamped()
    truth.pose.position.x, truth.pose.position.y = 0.002, 0.037
    truth.pose.orientation.z, truth.pose.orientation.w = math.sin(THETA / 2), math.cos(THETA / 2)
    page = opened(address)

    def say_until(condition, **tick):
        def said():
            state.publish(joints(theta=THETA, phi=PHI, v_x=0.001, **tick))
            pose.publish(truth)
            return page.evaluate(condition)

        observer.wait_for(said, condition)

    say_until(text_is('at-theta', '20.0°'), state=2.0, stop_reason=0.0)
    say_until("getComputedStyle(document.getElementById('object')).display !== 'none'", state=2.0)
    placed = page.locator('#object').get_attribute('transform')
    assert [float(x) for x in re.findall(r'-?[\d.]+', placed)] == pytest.approx([2.0, 37.0, 20.0])
    x1, y1, x2, y2 = coordinates(page, '#push', 'x1', 'y1', 'x2', 'y2')
    assert math.atan2(y2 - y1, x2 - x1) == pytest.approx(PHI, abs=1e-4)
    assert math.hypot(x1, y1) == pytest.approx(1e3 * R, abs=1e-3)
    corners = "(document.getElementById('outline').getAttribute('d') ?? '').split('L').length"
    say_until(f'{corners} === 4', state=2.0)
    assert page.locator('#alarm').text_content() == ''
    say_until(text_is('alarm', STOP), state=3.0, stop_reason=1.0)
    assert lasted(page, f'error {STOP}') == ('now', '1')
    say_until(text_is('alarm', ''), state=2.0, stop_reason=0.0)
    assert re.fullmatch(r'[\d.]+ s', lasted(page, f'error {STOP}')[0])
    said = log.read_text()
    process.send_signal(signal.SIGINT)
    assert process.wait(30.0) == 0
    assert log.read_text() == said


def test_estimate_has_its_intervals_along_the_edge(fed, opened):
    fed.frame()
    page = opened(fed.server.address)
    wait_for(page, text_is('at-d', '1.00 mm'))
    for shape, low, high in (('likely', -0.001, 0.004), ('guaranteed', -0.02, 0.02)):
        found = coordinates(page, f'#{shape}', 'x1', 'y1', 'x2', 'y2')
        # The contact is at d along the edge from the foot of the centre of mass, so where d is
        # greater the centre is further back.
        expected = [
            1e3 * (ESTIMATE[axis] + (0.001 - d) * (math.cos, math.sin)[axis](THETA))
            for d in (low, high)
            for axis in (0, 1)
        ]
        assert found == pytest.approx(expected, abs=2e-3)
    assert page.locator('h1').inner_text() == 'left'


def test_page_finds_its_server_again_and_says_so(opened):
    fed = Fed()
    with contextlib.closing(fed.server):
        fed.frame()
        fed.scene([[-20, -10], [20, -10], [0, 20]])
        page = opened(fed.server.address)
        wait_for(page, text_is('connection', 'live'))
        wait_for(page, "document.getElementById('outline').getAttribute('d') !== ''")
        wait_for(page, text_is('at-theta', '20.0°'))
        port = int(fed.server.address.rstrip('/').rpartition(':')[2])
    wait_for(page, "document.getElementById('connection').textContent.startsWith('no connection')")
    assert page.locator('#at-theta').inner_text() == '20.0°'  # the last that was known
    again = Fed(port)
    with contextlib.closing(again.server):
        again.frame(math.radians(7.0))
        wait_for(page, text_is('at-theta', '7.0°'))
        assert page.locator('#connection').text_content() == 'live'
        assert page.locator('canvas').count() == 5  # and not twice as many
        assert page.locator('#outline').get_attribute('d') == ''  # which nobody knows yet


def test_a_long_run_leaves_the_page_as_large_as_a_short_one(fed, opened):
    page = opened(fed.server.address)
    session = page.context.new_cdp_session(page)

    def measured(frames):
        for k in range(frames):
            last = fed.frame(THETA * math.sin(k / 10.0))
            time.sleep(0.0005)  # or most of them would only be replaced by newer ones
        wait_for(page, text_is('at-time', last))
        session.send('HeapProfiler.collectGarbage')
        metrics = {m['name']: m['value'] for m in session.send('Performance.getMetrics')['metrics']}
        return metrics['JSHeapUsedSize'], metrics['Nodes']

    session.send('Performance.enable')
    heap, nodes = measured(250)  # more than the page keeps
    heap_after, nodes_after = measured(1200)
    assert heap_after - heap < 200_000  # a frame that stays has 25 numbers, 200 byte
    assert nodes_after <= nodes


@pytest.mark.parametrize('scheme', ['light', 'dark'])
def test_a_phone_shows_it_without_horizontal_scrolling(fed, opened, scheme):
    for k in range(100):
        fed.frame(THETA * math.cos(k / 20.0))
    last = fed.frame(theta=math.nan, state=3.0, stop_reason=1.0)
    page = opened(fed.server.address, PHONE, has_touch=True, is_mobile=True, color_scheme=scheme)
    wait_for(page, text_is('alarm', STOP))
    wait_for(page, text_is('at-time', last))
    assert page.evaluate('document.documentElement.scrollWidth') == PHONE['width']
    for selector in ('#view', 'canvas', 'table'):
        for box in [one.bounding_box() for one in page.locator(selector).all()]:
            assert 0.0 <= box['x'] <= box['x'] + box['width'] <= PHONE['width'], selector
    ground = page.evaluate('getComputedStyle(document.body).backgroundColor')
    assert ('255' in ground) == (scheme == 'light')
    assert page.get_by_role('alert').inner_text() == STOP
    assert page.get_by_role('img', name='angle [°] over the last 10 seconds').is_visible()
    wait_for(page, f'{PICTURE_SIZE}(0) > 1.5 * {PICTURE_SIZE}(2)')  # of the tip nobody tells
