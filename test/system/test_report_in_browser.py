# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The page in a real browser: what it shows, what it does, and that it asks nobody for anything."""

import contextlib
import functools
import math
import re
import time
import zlib

import pytest

from support.browser import DESKTOP, PATIENCE, PHONE, wait_for
from support.pushed_bag import (
    DURATION,
    HOSTILE,
    SILENT,
    START,
    D,
    R,
    centre,
    estimated_pose,
    joint_state,
    messages,
    phi,
    theta,
    write_bag,
)
from tactile_push.bags import BagWriter
from tactile_push.cli import main

STATE = 'push_controller/state'
MARGINS = 54.0, 10.0  # of the plots, left and right [px]
READY = "performance.getEntriesByName('ready').length > 0"


@pytest.fixture(scope='module')
def page_file(tmp_path_factory):
    folder = tmp_path_factory.mktemp('report')
    bag = write_bag(folder / 'a rather long name for a bag <b>&amp; "quoted"')
    assert main(['report', str(bag), '-o', str(folder / 'page.html')]) == 0
    return folder / 'page.html'


class Tab:
    """A tab of a browser. What it shows must be quiet and ask nobody for anything.

    One tab shows all pages, one after the other: it knows the code of the plots after the first.
    """

    def __init__(self, browser, **options):
        self.page = browser.new_context(viewport=DESKTOP, **options).new_page()
        self._complaints, self._asked_for, self._shown = [], [], 0
        self.page.on('console', lambda message: self._complaints.append(message.text))
        self.page.on('pageerror', lambda error: self._complaints.append(str(error)))
        self.page.on('dialog', lambda dialog: self._complaints.append(dialog.message))
        self.page.on('request', lambda request: self._asked_for.append(request.url))

    def show(self, page_file, viewport=DESKTOP, scheme='light'):
        self.page.mouse.move(0, 0)
        self.page.set_viewport_size(viewport)
        self.page.emulate_media(color_scheme=scheme, media='screen')
        self.page.goto(page_file.as_uri())
        wait_for(self.page, READY)
        self._shown += 1
        return self.page

    def check(self):
        assert self._complaints == []
        fetched = [url for url in self._asked_for if not url.startswith(('data:', 'blob:'))]
        assert len(fetched) == self._shown
        assert all(url.startswith('file:') for url in fetched)


@contextlib.contextmanager
def tab_of(browser, **options):
    """Give a tab that is closed at the end."""
    tab = Tab(browser, **options)
    yield tab
    tab.page.context.close()
    tab.check()


@pytest.fixture(scope='module')
def shared_tab(browser):
    with tab_of(browser) as tab:
        yield tab


@pytest.fixture
def tab(shared_tab):
    yield shared_tab
    shared_tab.check()


@pytest.fixture
def opened(tab, page_file):
    """Return a function that opens the page for this test alone."""
    return functools.partial(tab.show, page_file)


@pytest.fixture(scope='module')
def page(browser, page_file):
    """Return a page for all tests that read it or move its time, and leave it so."""
    with tab_of(browser) as tab:
        yield tab.show(page_file)


def double_click(page, t, part, condition):
    """Double click into a plot until an expression is true: a slow page may see two clicks."""
    deadline = time.monotonic() + PATIENCE
    while not page.evaluate(condition):
        assert time.monotonic() < deadline, condition
        page.mouse.dblclick(*place(page, t, part))
        page.wait_for_timeout(1000)


def coordinates(page, selector, *names):
    return [float(page.locator(selector).get_attribute(name)) for name in names]


def move_slider(page, t):
    """Move the slider to a moment that has a frame."""
    last = int(page.locator('#time').get_attribute('max'))
    page.locator('#time').fill(str(round(t / DURATION * last)))


def time_of(page):
    return float(page.locator('#at-time').text_content().removesuffix(' s'))


def time_range(page):
    return page.evaluate("document.getElementById('plots').layout.xaxis.range")


def place(page, t, part):
    """Return where a time is, at a part of the height of the plots, from above [px]."""
    box = page.locator('#plots').bounding_box()
    left, right = MARGINS
    width = box['width'] - left - right
    return box['x'] + left + width * t / DURATION, box['y'] + part * box['height']


@pytest.mark.parametrize('t', [0.0, 2.5, 4.0, 11.9])
def test_slider_moves_the_view_to_what_the_bag_has(page, t):
    move_slider(page, t)
    assert time_of(page) == pytest.approx(t, abs=5e-3)
    normal = theta(t) + math.pi / 2.0
    start = [1e3 * R * math.cos(normal), 1e3 * R * math.sin(normal)]
    x1, y1, x2, y2 = coordinates(page, '#normal', 'x1', 'y1', 'x2', 'y2')
    assert [x1, y1] == pytest.approx(start, abs=1e-3)
    assert math.atan2(y2 - y1, x2 - x1) == pytest.approx(normal, abs=1e-4)
    x1, y1, x2, y2 = coordinates(page, '#push', 'x1', 'y1', 'x2', 'y2')
    assert [x1, y1] == pytest.approx(start, abs=1e-3)
    assert math.atan2(y2 - y1, x2 - x1) == pytest.approx(phi(t), abs=1e-4)
    x1, y1, x2, y2 = coordinates(page, '#edge', 'x1', 'y1', 'x2', 'y2')
    assert math.tan(theta(t)) == pytest.approx((y2 - y1) / (x2 - x1), abs=1e-4)
    assert [(x1 + x2) / 2.0, (y1 + y2) / 2.0] == pytest.approx(start, abs=1e-3)
    moved = re.findall(r'-?[\d.]+', page.locator('#object').get_attribute('transform'))
    x, y = centre(t)
    assert list(map(float, moved)) == pytest.approx(
        [1e3 * x, 1e3 * y, math.degrees(theta(t))], abs=2e-3
    )


def test_outline_is_that_of_the_block_in_the_parameters(page):
    corners = re.findall(r'-?[\d.]+,-?[\d.]+', page.locator('#outline').get_attribute('d'))
    corners = [tuple(map(float, corner.split(','))) for corner in corners]
    assert sorted(corners) == [(-25.0, -23.75), (-25.0, 23.75), (25.0, -23.75), (25.0, 23.75)]
    assert coordinates(page, '#finger', 'r') == [1e3 * R]


def test_friction_cone_opens_by_the_friction_to_both_sides_of_the_normal(page):
    move_slider(page, 1.0)
    shape = page.locator('#cone').get_attribute('d')
    (apex, right), left = re.findall(r'[ML](\S+?) ', shape.replace('Z', ' ')), shape.split(' ')[-1]
    (x, y), *sides = [
        tuple(map(float, point.strip('Z').split(','))) for point in (apex, right, left)
    ]
    normal = theta(1.0) + math.pi / 2.0
    angles = [math.atan2(b - y, a - x) - normal for a, b in sides]
    assert angles == pytest.approx([-math.atan(0.3), math.atan(0.3)], abs=1e-4)


def test_contact_disappears_while_it_is_silent_and_the_reason_is_told(page):
    move_slider(page, sum(SILENT) / 2.0)
    assert page.locator('#at-state').text_content() == 'stopped: contact silent'
    for shape in ('#normal', '#push', '#edge', '#cone'):
        assert not page.locator(shape).is_visible()
    assert page.locator('#object').is_visible()
    move_slider(page, SILENT[1] + 0.2)
    assert page.locator('#at-state').text_content() == 'pushing'
    assert page.locator('#normal').is_visible()


def test_keys_move_the_slider_and_press_the_button(page):
    slider = page.get_by_role('slider', name='Time')
    move_slider(page, 5.0)
    slider.press('ArrowRight')
    assert time_of(page) == pytest.approx(5.1, abs=5e-3)
    assert slider.get_attribute('aria-valuetext') == '5.1 seconds'
    slider.press('End')
    assert time_of(page) == pytest.approx(DURATION)
    slider.press('Tab')
    outline = 'getComputedStyle(document.activeElement).outlineStyle'
    assert page.evaluate('document.activeElement.textContent') == 'Play'
    assert page.evaluate(outline) == 'solid'


def test_button_plays_from_the_start_again_and_pauses(opened):
    page = opened()
    move_slider(page, DURATION)
    page.get_by_role('combobox', name='Speed').select_option('16×')
    page.get_by_role('button', name='Play').press('Enter')
    wait_for(page, "document.getElementById('time').value > 5")
    wait_for(page, "document.getElementById('play').textContent === 'Play'")
    assert time_of(page) == pytest.approx(DURATION)
    page.get_by_role('combobox', name='Speed').select_option('1×')
    page.get_by_role('button', name='Play').click()
    wait_for(page, "document.getElementById('time').value > 1")
    page.get_by_role('button', name='Pause').click()
    stood = time_of(page)
    page.wait_for_timeout(100)
    assert time_of(page) == stood < DURATION


@pytest.mark.parametrize('part', [0.12, 0.35, 0.55, 0.75])
def test_click_into_any_plot_moves_the_time_and_the_cursor(page, part):
    x, y = place(page, 9.0, part)
    page.mouse.click(x, y)
    assert time_of(page) == pytest.approx(9.0, abs=0.06)
    assert page.locator('#cursor').bounding_box()['x'] == pytest.approx(x, abs=1.5)


def test_zoom_in_one_plot_is_a_zoom_in_all_and_the_cursor_follows(opened):
    page = opened()
    move_slider(page, 4.0)
    page.mouse.move(*place(page, 3.0, 0.55))
    page.mouse.down()
    page.mouse.move(*place(page, 6.0, 0.55), steps=4)
    page.mouse.up()
    wait_for(page, "document.getElementById('plots').layout.xaxis.range[0] > 0")
    assert time_range(page) == pytest.approx([3.0, 6.0], abs=0.05)
    axes = page.evaluate("Object.keys(document.getElementById('plots').layout)")
    assert [name for name in axes if name.startswith('xaxis')] == ['xaxis']
    x, _ = place(page, DURATION / 3.0, 0.5)  # 4 s between 3 s and 6 s
    assert page.locator('#cursor').bounding_box()['x'] == pytest.approx(x, abs=2.0)
    assert time_of(page) == pytest.approx(4.0, abs=5e-3)
    page.emulate_media(color_scheme='dark')
    page.wait_for_timeout(100)
    assert time_range(page) == pytest.approx([3.0, 6.0], abs=0.05)
    move_slider(page, 8.0)
    assert not page.locator('#cursor').is_visible()
    double_click(page, 6.0, 0.55, "document.getElementById('plots').layout.xaxis.range[0] === 0")
    assert time_range(page) == [0.0, DURATION]


def test_pointer_over_one_plot_tells_the_values_of_all(opened):
    page = opened()
    page.mouse.move(*place(page, 4.0, 0.12))
    page.wait_for_selector('.hoverlayer text')
    told = page.locator('.hoverlayer text').all_text_contents()
    told = [text.replace('\u200b', '') for text in told]
    assert told[0] == 't: 4.00 s'
    assert f'θ : {math.degrees(theta(4.0)):.1f}°' in told
    assert f'φ − 90° : {math.degrees(phi(4.0)) - 90.0:.1f}°' in told
    assert 'vx commanded : 1.00 mm/s' in told
    assert f'd true : {1e3 * D:.2f} mm' in told
    assert 'silence of contact : 0.020 s' in told


def test_episodes_are_drawn_and_listed(page):
    rows = [row.split('\t') for row in page.locator('#events-section tr').all_inner_texts()]
    found = {row[0].strip(): row[1:] for row in rows}
    assert [float(cell) for cell in found['error controller: stopped: contact silent']] == (
        pytest.approx([1, 6.0, 1.0])
    )
    refused = found['warning readings: refused: out of plane']
    assert [float(cell) for cell in refused] == pytest.approx([1, 3.0, 0.1], abs=0.021)
    assert f'warning sensor_driver: {HOSTILE}' in found
    lanes = page.locator('#plots .annotation-text').all_text_contents()
    assert lanes == ['controller', 'readings', 'sensor_driver']


def test_nothing_that_the_bag_says_comes_to_life(opened):
    page = opened(viewport={'width': 1280, 'height': 1400})
    page.locator('details').evaluate_all('all => all.forEach(details => { details.open = true; })')
    assert page.evaluate('window.hacked') is None
    assert page.evaluate('document.images.length') == 0
    assert page.evaluate('document.scripts.length') == 3
    assert page.get_by_text(HOSTILE).count() >= 2
    assert page.title().startswith('a rather long name for a bag <b>&amp; "quoted"')
    page.mouse.move(*place(page, 9.0, 0.93))  # over the warning
    page.wait_for_selector('.hoverlayer text')
    assert page.evaluate('window.hacked') is None


def test_outcome_stands_beside_that_of_the_paper(page):
    rows = page.locator('#summary-section tr').all_inner_texts()
    found = {row.split('\t')[0]: row.replace('\u00a0', ' ').split('\t')[1:] for row in rows}
    steps = int(DURATION * 10) + 1 - 10  # less those in which the finger stood
    assert found['steps'] == [str(steps), '']
    # theta falls by 2° a second: it is never within 3° of -10° before the end at -4°.
    assert found['θ within 3° of θ_d from step'] == ['never', '173']
    assert found['stops'] == ['contact silent 1×', '']
    assert found['control ticks lost'] == ['0', '']


def luminance(color):
    """Return the relative luminance after WCAG 2.2 of rgb(r, g, b)."""
    parts = [int(part) / 255.0 for part in re.findall(r'\d+', color)[:3]]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
    return sum(weight * c for weight, c in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


def contrast(one, other):
    low, high = sorted(map(luminance, (one, other)))
    return (high + 0.05) / (low + 0.05)


def colors(page):
    return page.evaluate(
        """() => Object.fromEntries(
            ['paper', 'panel', 'text', 'muted', 'error', 'warning', 'note', 'blue', 'orange',
             'green', 'steel'].map((name) => {
              const probe = document.createElement('i');
              probe.style.color = `var(--${name})`;
              document.body.append(probe);
              const color = getComputedStyle(probe).color;
              probe.remove();
              return [name, color];
            }))"""
    )


def drawn_colors(page):
    """Return the colours of the plots' text and of the line of theta."""
    return page.evaluate(
        """() => [
            getComputedStyle(document.querySelector('#plots .xtick text')).fill,
            getComputedStyle(document.querySelectorAll('#plots .xy .lines path.js-line')[1]).stroke,
        ]"""
    )


@pytest.mark.parametrize('scheme', ['light', 'dark'])
def test_contrast_suffices_in_both_schemes(opened, scheme):
    page = opened(scheme=scheme)
    found = colors(page)
    assert (luminance(found['paper']) < 0.2) == (scheme == 'dark')
    for ground in ('paper', 'panel'):
        for name in ('text', 'muted', 'error', 'warning', 'note'):
            assert contrast(found[name], found[ground]) >= 4.5, (name, ground)
        for name in ('blue', 'orange', 'green'):
            assert contrast(found[name], found[ground]) >= 3.0, (name, ground)
    for name in ('blue', 'orange', 'green', 'text'):  # rays on the object
        assert contrast(found[name], found['steel']) >= 3.0, name
    assert drawn_colors(page) == [found['text'], found['blue']]


def test_plots_follow_the_scheme_while_the_page_is_open(opened):
    page = opened(scheme='light')
    light = drawn_colors(page)
    page.emulate_media(color_scheme='dark')
    wait_for(
        page,
        f"getComputedStyle(document.querySelector('#plots .xtick text')).fill !== '{light[0]}'",
    )
    dark = colors(page)
    assert drawn_colors(page) == [dark['text'], dark['blue']]


@pytest.fixture
def phone(browser, page_file):
    """Return the page on a phone."""
    with tab_of(browser, has_touch=True, is_mobile=True) as tab:
        yield tab.show(page_file, PHONE)


def test_phone_needs_no_horizontal_scrolling(phone):
    phone.locator('details').evaluate_all('all => all.forEach(details => { details.open = true; })')
    assert phone.evaluate('document.documentElement.scrollWidth') == PHONE['width']
    for selector in ('#view', '#plots svg.main-svg', '#time', '#play', '#speed', 'table'):
        for box in [one.bounding_box() for one in phone.locator(selector).all()]:
            assert box['x'] >= 0.0, selector
            if selector != 'table':  # which may scroll on its own
                assert box['x'] + box['width'] <= PHONE['width'], selector
    x, y = place(phone, 8.0, 0.5)
    phone.evaluate('y => scrollTo(0, y)', y - 300.0)
    x, y = place(phone, 8.0, 0.5)
    phone.touchscreen.tap(x, y)
    assert time_of(phone) == pytest.approx(8.0, abs=0.1)


def test_print_is_light_whole_and_without_controls(opened):
    page = opened(scheme='dark')
    page.evaluate(
        """() => addEventListener('beforeprint', () => {
            window.printed = {
              width: document.querySelector('#plots svg.main-svg').getBoundingClientRect().width,
              text: getComputedStyle(document.querySelector('#plots .xtick text')).fill,
              open: [...document.querySelectorAll('details')].every((details) => details.open),
            };
        })"""
    )
    pdf = page.pdf(format='A4')
    printed = page.evaluate('window.printed')
    assert printed['width'] <= (210.0 - 2 * 12.0) / 25.4 * 96.0  # what the margins leave of A4
    assert luminance(printed['text']) < 0.1
    assert printed['open']
    assert len(re.findall(rb'/Type /Page\b', pdf)) <= 5
    streams = re.findall(rb'stream\r?\n(.*?)endstream', pdf, re.DOTALL)
    drawn = b''.join(zlib.decompressobj().decompress(s) for s in streams if s[:1] == b'x')
    assert len(re.findall(rb' l\n', drawn)) > 5 * DURATION * 10  # lines of the plots
    page.emulate_media(media='print')
    for gone in ('#play', '#time', '#speed', '#cursor', '#hint', '.modebar'):
        assert not page.locator(gone).first.is_visible(), gone
    for there in ('#view', '#plots', '#summary-section table', '#events-section table'):
        assert page.locator(there).is_visible(), there


def test_screen_is_as_before_after_printing(opened):
    page = opened(scheme='dark')
    before = drawn_colors(page), page.locator('#plots svg.main-svg').first.bounding_box()
    page.pdf(format='A4')
    wait_for(page, '!document.documentElement.classList.contains("printing")')
    after = drawn_colors(page), page.locator('#plots svg.main-svg').first.bounding_box()
    assert after == before
    assert not page.locator('details').first.evaluate('details => details.open')


def test_run_without_a_simulator_has_finger_and_contact_and_no_object(tab, tmp_path):
    bag = write_bag(tmp_path / 'bag', truth=False, parameters=None)
    assert main(['report', str(bag), '-o', str(tmp_path / 'page.html')]) == 0
    page = tab.show(tmp_path / 'page.html')
    move_slider(page, 4.0)
    normal = theta(4.0) + math.pi / 2.0
    assert coordinates(page, '#normal', 'x1', 'y1') == pytest.approx(
        [1e3 * R * math.cos(normal), 1e3 * R * math.sin(normal)], abs=1e-3
    )
    for there in ('#finger', '#edge', '#push'):
        assert page.locator(there).is_visible(), there
    for missing in ('#object', '#cone', '#estimate'):
        assert not page.locator(missing).is_visible(), missing
    key = page.locator('#key').inner_text()
    assert 'object' not in key
    assert 'estimated' not in key


@pytest.mark.parametrize('own', ['tactile', 'contact', 'ground_truth/object_pose', STATE])
def test_page_of_a_single_message_works(tab, tmp_path, own):
    ((kind, data),) = [row[1:] for row in messages(0.0, tick=True) if row[0] == own]
    with BagWriter(tmp_path / 'bag') as bag:
        bag.add_topic(f'/{own}', kind)
        bag.write(f'/{own}', data, START, START)
    assert main(['report', str(tmp_path / 'bag'), '-o', str(tmp_path / 'page.html')]) == 0
    page = tab.show(tmp_path / 'page.html')
    assert time_of(page) == 0.0
    assert page.locator('#normal').is_visible() == (own in ('contact', STATE))
    assert page.locator('#plots-section').is_visible() == (own != 'ground_truth/object_pose')


def test_estimates_are_drawn_with_their_bounds(tab, tmp_path):
    with BagWriter(tmp_path / 'bag') as bag:
        kind = 'geometry_msgs/msg/PoseWithCovarianceStamped'
        bag.add_topic('/active_sensing/state', 'sensor_msgs/msg/JointState')
        bag.add_topic('/object_pose', kind)
        for k in range(20):
            t, now = k / 10.0, START + k * 100_000_000
            bounds = {'d_lower': -0.001 * k, 'd_upper': 0.002, 'd_least': -0.025, 'd_most': 0.025}
            state = joint_state(t, d=0.001, **bounds)
            bag.write('/active_sensing/state', state, now, now)
            bag.write('/object_pose', estimated_pose(t, 0.001 * k, 0.04), now, now)
    assert main(['report', str(tmp_path / 'bag'), '-o', str(tmp_path / 'page.html')]) == 0
    page = tab.show(tmp_path / 'page.html')
    page.locator('#time').press('End')
    assert page.locator('#at-d').text_content() == '1.00 mm'
    moved = re.findall(r'-?[\d.]+', page.locator('#estimate').get_attribute('transform'))
    assert list(map(float, moved)) == pytest.approx([19.0, 40.0])
    assert 'centre of mass, estimated' in page.locator('#key').inner_text()
    legend = page.locator('#plots .legendtext').all_text_contents()
    assert sorted(legend) == ['95 %', 'estimated', 'guaranteed']
    assert page.locator('#plots .fills path').count() == 2
    # Bounds as wide as the object do not make d a line that nobody can read.
    low, high = page.evaluate("document.getElementById('plots').layout.yaxis.range")
    assert -5.0 < low < 1.0 < high < 5.0
