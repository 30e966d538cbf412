# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push report`: which file it writes, what it says, and how it ends."""

import json
from pathlib import Path

import pytest

pytest.importorskip('plotly')

from support.commands import BAG, few_bytes, run_command
from support.pushed_bag import START, write_bag
from tactile_push.bags import BagWriter
from tactile_push.cli import main


@pytest.fixture(scope='module')
def bag(tmp_path_factory):
    return write_bag(tmp_path_factory.mktemp('bags') / 'pushed')


def contents(folder):
    return {path: path.read_bytes() for path in folder.iterdir()}


def test_plotly_that_is_missing_is_said_in_one_line(bag, monkeypatch, capsys):
    monkeypatch.setattr('tactile_push.cli.report.find_spec', lambda name: None)
    assert main(['report', str(bag)]) == 2
    assert capsys.readouterr().err == 'tactile_push report: needs plotly: pip install plotly\n'


def test_page_gets_the_name_of_the_bag_and_lies_here(bag, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    before = contents(bag)
    assert main(['report', str(bag)]) == 0
    assert capsys.readouterr().out == 'pushed.html\n'
    assert (tmp_path / 'pushed.html').read_text().startswith('<!DOCTYPE html>')
    assert contents(bag) == before


def test_bag_may_be_its_file_and_the_folder_one_stands_in(bag, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(['report', str(bag / 'pushed_0.mcap'), '--json']) == 0
    assert json.loads(capsys.readouterr().out) == {'file': 'pushed_0.html'}
    assert (tmp_path / 'pushed_0.html').exists()
    monkeypatch.chdir(bag)
    assert main(['report', '.', '-o', str(tmp_path / 'here.html')]) == 0
    assert '<h1>pushed</h1>' in (tmp_path / 'here.html').read_text()


def test_page_that_is_there_is_replaced(bag, tmp_path):
    (tmp_path / 'page.html').write_text('old')
    assert main(['report', str(bag), '-o', str(tmp_path / 'page.html')]) == 0
    assert (tmp_path / 'page.html').read_text() != 'old'


def test_name_that_is_no_text_is_shown_as_far_as_it_goes(tmp_path):
    with BagWriter(tmp_path / 'b\udcffg') as bag:
        bag.add_topic('/tactile', 'sensor_msgs/msg/JointState')
        bag.write('/tactile', b'\x00\x01\x00\x00' + bytes(44), START, START)
    assert main(['report', str(tmp_path / 'b\udcffg'), '-o', str(tmp_path / 'page.html')]) == 0
    assert '<h1>b?g</h1>' in (tmp_path / 'page.html').read_text()


@pytest.mark.parametrize('name', ['page', 'pushed_0.mcap', 'page.txt'])
def test_page_is_called_html_so_that_it_replaces_no_bag(bag, name, capsys):
    with pytest.raises(SystemExit) as ended:
        main(['report', str(bag), '-o', str(bag / name)])
    assert ended.value.code == 2
    assert f'expected a file *.html, got {bag / name}' in capsys.readouterr().err


def test_what_cannot_be_read_or_written_ends_with_2_and_one_line(bag, tmp_path, capsys):
    (tmp_path / 'text.mcap').write_text('no bag')
    for arguments in (
        [str(tmp_path / 'missing')],
        [str(tmp_path / 'text.mcap')],
        [str(bag), '-o', str(tmp_path / 'not' / 'there.html')],
    ):
        assert main(['report', *arguments]) == 2
        out, err = capsys.readouterr()
        assert out == ''
        assert err.startswith('tactile_push report: ')
        assert err.count('\n') == 1
        assert str(tmp_path) in err


def test_damage_is_told_on_the_page_and_beside_it(bag, tmp_path, capsys):
    whole = (bag / 'pushed_0.mcap').read_bytes()
    (tmp_path / 'cut.mcap').write_bytes(whole[: len(whole) * 3 // 4])
    assert main(['report', str(tmp_path / 'cut.mcap'), '-o', str(tmp_path / 'page.html')]) == 0
    (warning,) = capsys.readouterr().err.splitlines()
    assert warning.startswith('tactile_push report: warning: ')
    told = warning.removeprefix('tactile_push report: warning: ')
    assert f'<p>{told}</p>' in (tmp_path / 'page.html').read_text()


@pytest.mark.slow
def test_page_that_cannot_be_written_leaves_the_old_one(tmp_path: Path):
    page = tmp_path / 'page.html'
    page.write_text('old')
    done = run_command('report', BAG, '-o', page, preexec_fn=few_bytes)
    assert done.returncode == 2
    assert done.stderr == f'tactile_push report: {page}: File too large\n'
    assert page.read_text() == 'old'
    assert list(tmp_path.iterdir()) == [page]
