# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The page as text: what stands in it, that nothing of a bag becomes markup, and its size."""

import base64
import hashlib
import json
import math
from html.parser import HTMLParser

import numpy as np
import pytest

pytest.importorskip('plotly')

from tactile_push.report import report_html
from tactile_push.report.data import Episode, Run, Scene, Series
from tactile_push.report.placings import GOAL_HEADS

HOSTILE = '</script><script>alert(1)</script><img src=x onerror=alert(2)>&amp;\u2028"\''
TIME = np.arange(0.0, 20.0, 0.1)
THETA = np.radians(20.0) - 0.02 * TIME


class Page(HTMLParser):
    """The elements of a page, and the texts in them."""

    def __init__(self, text):
        super().__init__()
        self.elements = []
        self.texts = []
        self._open = ''
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))
        self._open = tag

    def handle_endtag(self, tag):
        self._open = ''

    def handle_data(self, data):
        self.texts.append((self._open, data))

    def tags(self, name):
        return [attributes for tag, attributes in self.elements if tag == name]

    def inside(self, name):
        return [text for tag, text in self.texts if tag == name]


def make_run(**changes):
    run = {
        'name': 'block',
        'duration': 20.0,
        'series': {
            'theta': Series(TIME, THETA),
            'phi': Series(TIME, np.full(len(TIME), math.pi / 2.0)),
            'v_x': Series(TIME, np.where(TIME < 1.0, np.nan, 0.001)),
        },
        'states': ['pushing'],
        'episodes': [],
        'scene': Scene(0.0135, [(0.0, 0.0), (0.01, 0.0), (0.0, 0.01)], mu_c=0.3),
    }
    return Run(**(run | changes))


def data_of(text):
    (content,) = [
        data
        for page in [Page(text)]
        for tag, data in page.texts
        if tag == 'script' and data.startswith('{')
    ]

    def refuse(constant):
        raise AssertionError(f'{constant} is not JSON')

    return json.loads(content, parse_constant=refuse)


def test_numbers_are_those_that_people_read():
    data = data_of(report_html(make_run()))
    assert data['series']['theta']['time'] == pytest.approx(TIME.tolist())
    assert data['series']['theta']['values'] == pytest.approx(np.degrees(THETA), abs=1e-3)
    assert set(data['series']['phi']['values']) == {0.0}
    assert data['series']['v_x']['values'][:10] == [None] * 10
    assert data['series']['v_x']['values'][10:] == [1.0] * 190
    assert data['scene']['radius'] == pytest.approx(13.5)
    assert data['scene']['outline'] == [[0.0, 0.0], [10.0, 0.0], [0.0, 10.0]]
    assert data['scene']['mu_c'] == 0.3


def test_goals_have_a_table_and_their_drawings():
    goals = [('-50.00 mm, 5.73°', '', HOSTILE, '50 mm', 'with reserve', 'missed')]
    drawing = '<svg class="placed" viewBox="0 0 1 1"><path d="M0 0L1 1"/></svg>'
    text = report_html(make_run(goals=goals, drawings=[(f'Goal 1: {HOSTILE}', drawing)]))
    page = Page(text)
    assert 'Placed objects' in page.inside('h2')
    assert set(GOAL_HEADS) <= set(page.inside('th'))
    assert f'Goal 1: {HOSTILE}' in page.inside('figcaption')
    assert HOSTILE in page.inside('td')
    assert len([tag for tag in page.tags('svg') if tag.get('class') == 'placed']) == 1
    assert 'placed-key' in [tag.get('id') for tag in page.tags('ul')]


def test_a_run_without_goals_has_no_section_of_them():
    text = report_html(make_run())
    assert 'placed-section' not in text
    assert 'Placed objects' not in Page(text).inside('h2')


def test_infinite_and_unknown_friction_are_told_apart():
    assert data_of(report_html(make_run(scene=Scene(0.01, mu_c=math.inf))))['scene']['mu_c'] == (
        'infinite'
    )
    assert data_of(report_html(make_run(scene=Scene(0.01))))['scene']['mu_c'] is None


def test_values_that_are_no_numbers_become_null():
    values = np.array([math.nan, math.inf, -math.inf, 1.0])
    series = {'silence': Series(np.arange(4.0), values)}
    data = data_of(report_html(make_run(series=series)))
    assert data['series']['silence']['values'] == [None, None, None, 1.0]


def test_turn_of_the_tip_is_shown_from_straight_ahead():
    series = {'psi': Series(np.arange(2.0), np.radians([90.0, 60.0]))}
    data = data_of(report_html(make_run(series=series)))
    assert data['series']['psi']['values'] == [0.0, -30.0]
    assert data['frames']['psi'][0] == 0.0


def test_view_shows_the_last_value_and_none_that_is_old():
    series = {'theta': Series(np.array([1.0, 2.0]), np.radians([10.0, 20.0]))}
    frames = data_of(report_html(make_run(duration=10.0, series=series)))['frames']
    shown = dict(zip(frames['time'], frames['theta'], strict=True))
    assert shown[0.9] is None
    assert shown[1.0] == shown[1.9] == pytest.approx(10.0)
    assert shown[2.0] == shown[3.0] == pytest.approx(20.0)
    assert shown[3.1] is None


def test_everything_that_a_bag_says_is_text():
    run = make_run(
        name=HOSTILE,
        states=[HOSTILE],
        episodes=[Episode(HOSTILE, 1.0, 2.0, HOSTILE, 'error')],
        facts=[HOSTILE],
        outcome=[(HOSTILE, HOSTILE, HOSTILE)],
        tables={HOSTILE: [(HOSTILE, HOSTILE)]},
        warnings=[HOSTILE],
    )
    harmless, hostile = Page(report_html(make_run())), Page(report_html(run))
    assert len(hostile.tags('script')) == len(harmless.tags('script')) == 3
    assert hostile.tags('img') == []
    for tag in ('title', 'h1', 'summary', 'td', 'th'):
        assert any(HOSTILE in text for text in hostile.inside(tag)), tag
    assert data_of(report_html(run))['episodes'][0]['text'] == HOSTILE


def test_browser_is_allowed_the_scripts_of_the_page_alone():
    page = Page(report_html(make_run()))
    (policy,) = [meta['content'] for meta in page.tags('meta') if 'http-equiv' in meta]
    rules = dict(rule.split(' ', 1) for rule in policy.split('; '))
    assert rules['default-src'] == "'none'"
    assert rules['img-src'] == 'data: blob:'
    scripts = [text for text in page.inside('script') if not text.startswith('{"duration"')]
    hashes = [base64.b64encode(hashlib.sha256(text.encode()).digest()) for text in scripts]
    assert len(hashes) == 2
    assert set(rules['script-src'].split()) == {f"'sha256-{hash.decode()}'" for hash in hashes}


def test_page_names_its_language_and_fetches_nothing():
    page = Page(report_html(make_run()))
    assert page.tags('html') == [{'lang': 'en'}]
    for tag, attributes in page.elements:
        assert 'src' not in attributes, tag
        assert attributes.get('href', 'data:').startswith('data:'), tag
    assert 'url(#belt)' in [rect.get('fill') for rect in page.tags('rect')]
    assert 'http' not in ''.join(page.inside('style'))


def test_episodes_are_counted_by_kind_the_gravest_first():
    episodes = [
        Episode('driver', 1.0, 1.5, 'late', 'warning'),
        Episode('controller', 2.0, 5.0, 'stopped', 'error'),
        Episode('driver', 7.0, 8.0, 'late', 'warning'),
    ]
    text = report_html(make_run(episodes=episodes))
    rows = [row.split('</tr>')[0] for row in text.split('<tr>')[2:]]
    assert [Page(row).inside('td') for row in rows] == [
        ['1', '2.00', '3.00'],
        ['2', '1.00', '1.50'],
    ]
    assert 'controller: stopped' in rows[0]
    assert 'driver: late' in rows[1]
    assert data_of(text)['lanes'] == ['controller', 'driver']


def test_plot_joins_what_would_be_seen_as_one_and_the_table_does_not():
    episodes = [Episode('node', k / 100.0, k / 100.0, 'late', 'warning') for k in range(0, 200, 2)]
    text = report_html(make_run(duration=30.0, episodes=episodes))
    (drawn,) = data_of(text)['episodes']
    assert (drawn['start'], drawn['end']) == (0.0, 1.98)
    assert Page(text).inside('td') == ['100', '0.00', '0.00']


def test_very_many_kinds_of_episodes_are_cut_off_with_a_word():
    episodes = [Episode('driver', float(k), k + 0.5, f'kind {k}', 'note') for k in range(80)]
    assert 'And 30 more kinds.' in report_html(make_run(duration=100.0, episodes=episodes))


@pytest.mark.parametrize('duration', [0.0, 600.0])
def test_page_has_a_bounded_size_and_a_bounded_number_of_points(duration):
    fast = np.linspace(0.0, duration, int(duration) * 100 + 1)
    noise = np.random.default_rng(1).normal(size=len(fast))
    names = ('theta', 'theta_desired', 'phi', 'v_x', 'v_x_true', 'd', 'd_lower', 'd_upper')
    names += ('d_least', 'd_most', 'psi')
    names += ('d_true', 'silence', 'interval', 'object_x', 'object_y', 'object_angle', 'finger_x')
    run = make_run(duration=duration, series={name: Series(fast, noise) for name in names})
    text = report_html(run)
    data = data_of(text)
    assert all(len(line['time']) == len(line['values']) <= 6000 for line in data['series'].values())
    assert len(data['frames']['time']) <= 6001
    assert len(text) < 8e6


def test_run_of_a_single_moment():
    data = data_of(report_html(make_run(duration=0.0, series={})))
    assert data['duration'] > 0.0
    assert data['series'] == {}
