# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What somebody may name where a command or node expects a file, a folder or a number."""

import os
import sys
from collections.abc import Iterator
from pathlib import Path

from tactile_push.interface import NODES

BAG = Path(__file__).resolve().parents[1] / 'data' / 'block'
COMMAND = (sys.executable, '-m', 'tactile_push.cli')
LETTERS_OF_A_NAME = 300  # more than a file system takes

Words = tuple[object, ...]


def commands(folder: Path) -> dict[str, Words]:
    """Return quick uses of every command and node by name, which write into a folder."""
    words: dict[str, Words] = {
        'help': ('--help',),
        'simulate': ('simulate', '--steps', 20, '--json', folder / 'run.json'),
        'simulate and plot': ('simulate', '--steps', 3, '--plot', folder / 'run.png'),
        'info': ('info', BAG),
        'diff': ('diff', BAG, BAG, '--json'),
        'replay': ('replay', BAG, '-o', folder / 'replayed'),
        'estimate': ('estimate', BAG),
        'report': ('report', BAG, '-o', folder / 'page.html'),
        'play': ('play', BAG, '--rate', 100, '--duration', 0.5),
        'demo': ('demo', '-o', '/etc/passwd'),  # refused
        'record': ('record', '-o', BAG),  # refused
        'figures': ('figures', '-o', '/etc/passwd'),  # refused
    }
    found: dict[str, Words] = {name: (*COMMAND, *rest) for name, rest in words.items()}
    for node in sorted(NODES):
        begin = (sys.executable, '-m', f'tactile_push.nodes.{node}')
        found[f'{node} --help'] = (*begin, '--help')
        found[f'{node} refused'] = (*begin, '--ros-args', '-p', 'use_sim_time:=much')
    return found


def things(folder: Path) -> dict[str, Path]:
    """Return what is no bag and no file of any kind that is asked for, made in a folder."""
    made = {
        'nothing there': folder / 'nowhere',
        'empty folder': folder / 'folder',
        'empty file': folder / 'empty.mcap',
        'pipe': folder / 'pipe',
        'text': folder / 'text.yaml',
        'bytes': folder / 'bytes.json',
        'zeroes': folder / 'zeroes.mcap',
        'half a bag': folder / 'half.mcap',
        'nested': folder / 'nested.yaml',
        'a link to itself': folder / 'loop',
        'unreadable': Path('/proc/self/mem'),
        'device': Path('/dev/full'),
        'null': Path(os.devnull),
        'below a file': Path('/etc/passwd/file'),
        'too long a name': folder / ('x' * LETTERS_OF_A_NAME),
        'a name of no letters': folder / '\udcff\n\x1b[31m',
        'nobody': Path(''),
    }
    made['empty folder'].mkdir()
    made['empty file'].touch()
    os.mkfifo(made['pipe'])
    made['text'].write_text('/**:\n  ros__parameters:\n    kp: [1\n')
    made['bytes'].write_bytes(bytes(range(256)) * 40)
    made['zeroes'].write_bytes(bytes(100_000))
    whole = next(BAG.glob('*.mcap')).read_bytes()
    made['half a bag'].write_bytes(whole[: len(whole) // 2])
    made['nested'].write_text('[' * 100_000)
    made['a link to itself'].symlink_to(made['a link to itself'])
    made['a name of no letters'].touch()
    return made


def uses(thing: Path, folder: Path) -> Iterator[Words]:
    """Yield uses of every command and node that takes a file or folder, of this one."""
    for command in ('info', 'replay', 'estimate', 'play'):
        yield *COMMAND, command, thing
    yield *COMMAND, 'diff', thing, BAG
    yield *COMMAND, 'report', thing, '-o', folder / 'page.html'
    yield *COMMAND, 'report', BAG, '-o', thing / 'page.html'
    yield *COMMAND, 'replay', BAG, '--config', thing
    yield *COMMAND, 'replay', BAG, '-o', thing / 'out'
    yield *COMMAND, 'estimate', BAG, '--config', thing
    yield *COMMAND, 'estimate', BAG, '--json', thing
    yield *COMMAND, 'simulate', '--steps', 3, '--object', thing
    yield *COMMAND, 'simulate', '--steps', 3, '--support', thing
    yield *COMMAND, 'simulate', '--steps', 3, '--json', thing
    yield *COMMAND, 'identify', thing
    yield *COMMAND, 'identify', BAG, '--outline', thing
    yield *COMMAND, 'record', '-o', thing / 'out', '--max-size', 'much'
    yield *COMMAND, 'calibrate', 'camera', thing, '-o', folder / 'camera.yaml'
    yield *COMMAND, 'calibrate', 'wrench', BAG, '--touches', thing, '-o', folder / 'wrench.yaml'
    for node in sorted(NODES):
        begin = (sys.executable, '-m', f'tactile_push.nodes.{node}', '--ros-args')
        yield *begin, '--params-file', thing, '-p', 'use_sim_time:=much'


SLIPS = (  # of numbers and words
    ('simulate', '--steps', '-1'),
    ('simulate', '--steps', '1e3'),
    ('simulate', '--mu-c', 'nan'),
    ('simulate', '--theta0-deg', '1,5'),
    ('simulate', '--support', 'circle:x'),
    ('simulate', '--plot', 'run.xyz'),
    ('play', BAG, '--rate', '0'),
    ('play', BAG, '--topics', '/nowhere'),
    ('play', BAG, '--remap', 'x'),
    ('play', BAG, '--start', '1e9'),
    ('replay', BAG, '--kp', 'much'),
    ('estimate', BAG, '--edge', '99'),
    ('estimate', BAG, '--noise-deg', '-1'),
    ('identify', BAG),
    ('identify', BAG, '--plot', 'pushes.xyz'),
    ('diff', BAG),
    ('diff', BAG, BAG, '--tolerance', 'x=y'),
    ('record', '--compression', 'zip'),
    ('record', '--max-size', '-1'),
    ('info', BAG, BAG),
    ('nowhere',),
    (),
    ('--version',),
    ('info', ''),
    ('info', '--'),
    ('simulate', '--object', ''),
)
