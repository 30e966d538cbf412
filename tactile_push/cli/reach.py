# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push reach`: the places and angles to which an object can be brought from a start."""

import argparse
import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tactile_push.cli.arguments import Commands, Refused, number, picture
from tactile_push.cli.pushed_object import FACING, LENGTH, add_object, add_start, config_of

if TYPE_CHECKING:
    from tactile_push.control.placing.model import Goal
    from tactile_push.control.placing.reachability import Task
    from tactile_push.control.placing.reachable_set import ReachableSet

X_STEP, THETA_STEP = 0.005, math.radians(5.0)  # of the goals that are tried [m, rad]
BESIDE = 0.03  # how far beyond the finger's workspace the centre of mass may be [m]
BELTS = number('millimetres from 1 to 5000', 1.0, 5000.0)


def add(commands: Commands) -> None:
    """Add the command."""
    reach = commands.add_parser(
        'reach',
        help='draw where, and at which angle, an object can be placed from a start',
        description='Tells to which places across the belt and angles an object can be brought '
        'at the same moment: with reserve, at the limits, or not, and why not. x counts from where '
        'the finger starts. With a goal it says whether that one can be reached, and which one '
        'near it can. Exit status: 0 done, 1 the goal is out of reach, 2 bad input.',
        formatter_class=argparse.ArgumentDefaultsHelpFormatter,
    )
    option = reach.add_argument
    add_object(option)
    option(
        '--c-mm',
        type=number('a positive number of millimetres', 0.0, sys.float_info.max, closed=False),
        default=argparse.SUPPRESS,
        metavar='MM',
        help='ratio m_max / f_max of the ellipsoid, in place of a support',
    )
    add_start(option)
    option(
        '--x0-mm',
        type=LENGTH,
        default=argparse.SUPPRESS,
        metavar='MM',
        help='where the finger starts in its workspace, x of its disk in finger_base (default: the '
        "usual finger's, -60)",
    )
    option('--belt-mm', type=BELTS, default=300.0, metavar='MM', help='belt that there is')
    option(
        '--x-goal-mm',
        type=LENGTH,
        default=argparse.SUPPRESS,
        metavar='MM',
        help='where the centre of mass shall be across the belt',
    )
    option(
        '--theta-goal-deg',
        type=FACING,
        default=argparse.SUPPRESS,
        metavar='DEG',
        help='angle that the edge shall have there',
    )
    option(
        '-o',
        '--out',
        type=picture,
        default=argparse.SUPPRESS,
        metavar='FILE',
        help='draw the set of reachable goals; the ending chooses the format',
    )
    option(
        '--json',
        metavar='FILE|-',
        default=argparse.SUPPRESS,
        help='write what is found as one JSON object in SI units; - prints it instead of the lines',
    )
    reach.set_defaults(run=_reach)


def _reach(options: argparse.Namespace) -> int:
    from rich.console import Console

    from tactile_push.cli.output import naming, plain, write_json

    has_x, has_theta = (hasattr(options, name) for name in ('x_goal_mm', 'theta_goal_deg'))
    if has_x != has_theta:
        given, missing = '--x-goal-mm', '--theta-goal-deg'
        if has_theta:
            given, missing = missing, given
        raise Refused(f'{missing}: expected one with {given}, got none')
    if hasattr(options, 'c_mm') and hasattr(options, 'support'):
        raise Refused('--c-mm: expected no --support with it, got one')
    out, json_file = (getattr(options, name, None) for name in ('out', 'json'))
    try:
        task, start = _task(options)
    except ValueError as error:
        raise Refused(error) from None
    with Console(stderr=True).status('planning (the first time, compiling)'):
        told = None
        if has_x:
            told = _told(task, start, options.x_goal_mm / 1e3, options.theta_goal_deg)
    found = _set(task, start) if told is None or out is not None else None
    content = _content(task, start, told, found)
    if json_file is not None:
        with naming(json_file, '--json'):
            write_json(json_file, plain(content))
    if out is not None and found is not None:
        with naming(out, '--out'):
            _draw(out, content, found)
    if json_file != '-':
        _print(content, found)
    return 1 if told is not None and told['reason'] else 0


def _task(options: argparse.Namespace) -> 'tuple[Task, float]':
    """Return from where the goals have to be reached, and where the finger starts [m]."""
    from dataclasses import replace

    from tactile_push import paper
    from tactile_push.control import Limits
    from tactile_push.control.placing.law import LARGEST_ANGLE
    from tactile_push.control.placing.model import Bounds, Situation
    from tactile_push.control.placing.reachability import Task
    from tactile_push.mechanics import Slider
    from tactile_push.simulation.by_touch import LAG, check_edges
    from tactile_push.simulation.placement import edge_ends, pushed_of, tip_of

    config = config_of(options)
    if hasattr(options, 'c_mm'):
        config = replace(config, slider=Slider(config.slider.outline, options.c_mm / 1e3))
    check_edges(config, 'place')
    limits, finger = Limits(), config.finger
    x = options.x0_mm / 1e3 if hasattr(options, 'x0_mm') else config.tip.x
    if not limits.workspace_min <= x <= limits.workspace_max:
        raise ValueError(
            f'--x0-mm: expected {1e3 * limits.workspace_min:g} to {1e3 * limits.workspace_max:g}, '
            f'the workspace, got {1e3 * x:g}'
        )
    ends = edge_ends(config)
    d = config.d if config.d is not None else min(max(0.0, ends[0]), ends[1])
    bounds = Bounds(
        1.0 / math.tan(paper.PHI_MIN),
        limits.max_acceleration / config.belt_speed**2,
        *(limits.workspace_min, limits.workspace_max),
        *(*ends, LARGEST_ANGLE, math.pi / 2.0),
    )
    pushed = pushed_of(config)._replace(
        tip=tip_of(config, finger.inverse(x, config.tip.y)), lag=LAG * config.belt_speed
    )
    now = Situation(x, config.theta, d, 0.0, 0.0)
    return Task(now, pushed, bounds, options.belt_mm / 1e3), x


def _told(task: 'Task', start: float, x: float, theta_deg: float) -> dict[str, Any]:
    """Return what is said of a goal, x from where the finger starts."""
    from tactile_push.control.placing.model import Goal
    from tactile_push.control.placing.reachability import (
        nearest_goal,
        on_the_way,
        reach,
        with_reserve,
    )
    from tactile_push.control.placing.stages import OUT_OF_REACH

    goal = Goal(start + x, math.radians(theta_deg))
    found = reach(task, goal)
    nearest = None
    if found.verdict == OUT_OF_REACH:
        nearest = nearest_goal(with_reserve(task), goal) or nearest_goal(task, goal)
        nearest = nearest or on_the_way(task, goal)
    return {
        'goal': _place(goal, start),
        'verdict': found.verdict,
        'reason': found.reason,
        'belt': found.plan.length if found.plan is not None and found.plan.arrives else math.nan,
        'nearest': None if nearest is None else _place(nearest, start),
    }


def _place(goal: 'Goal', start: float) -> dict[str, float]:
    return {'x': goal.x - start, 'theta': goal.theta}


def _set(task: 'Task', start: float) -> 'ReachableSet':
    """Find out about goals all over the workspace, and show how far that is."""
    from rich.console import Console
    from rich.progress import Progress

    from tactile_push.control.placing.reachable_set import ReachableSet, reachable_set

    bounds = task.bounds
    first = math.ceil((bounds.x_min - BESIDE - start) / X_STEP)
    last = math.floor((bounds.x_max + BESIDE - start) / X_STEP)
    xs = [start + X_STEP * k for k in range(first, last + 1)]
    most = round(bounds.theta_max / THETA_STEP)
    thetas = [THETA_STEP * k for k in range(-most, most + 1)]
    console = Console(stderr=True)
    with Progress(console=console, transient=True, disable=not console.is_terminal) as bar:
        line = bar.add_task('planning', total=len(xs) * len(thetas))
        found = reachable_set(task, xs, thetas, lambda done: bar.update(line, completed=done))
    return ReachableSet(tuple(X_STEP * k for k in range(first, last + 1)), found.thetas, found.told)


def _content(
    task: 'Task', start: float, told: dict[str, Any] | None, found: 'ReachableSet | None'
) -> dict[str, Any]:
    from tactile_push.control.placing.model import centre_of_mass

    now, pushed = task.now, task.pushed
    content: dict[str, Any] = {
        'start': {
            'x': float(centre_of_mass(now, pushed)) - start,
            'theta': now.theta,
            'd': now.d,
            'finger_x': start,
        },
        'object': {
            'l': pushed.l,
            'c': math.sqrt(pushed.pressure.c_squared),
            'growth': pushed.pressure.growth,
            'mu_c': pushed.sin_alpha / pushed.cos_alpha if pushed.cos_alpha > 0.0 else math.inf,
        },
        'belt': task.belt,
    }
    if told is not None:
        content['goal'] = told
    if found is not None:
        verdicts = [[verdict for verdict, _ in row] for row in found.told]
        reasons = [[reason for _, reason in row] for row in found.told]
        grid = {'x': list(found.xs), 'theta': list(found.thetas)}
        content['set'] = {**grid, 'verdict': verdicts, 'reason': reasons}
    return content


def _draw(file: Path, content: dict[str, Any], found: 'ReachableSet') -> None:
    from tactile_push.figures.reachable import plot_reachable  # which loads matplotlib

    marks = {'start': content['start'], **content.get('goal', {})}
    places = {name: marks.get(name) for name in ('start', 'goal', 'nearest')}
    plot_reachable(
        found,
        {name: (place['x'], place['theta']) for name, place in places.items() if place},
        [file],
    )


def _print(content: dict[str, Any], found: 'ReachableSet | None') -> None:
    from tactile_push.control.placing.stages import (
        AT_THE_LIMITS,
        OUT_OF_REACH,
        REASONS,
        WITH_RESERVE,
    )

    start, thing = content['start'], content['object']
    c, l = 1e3 * thing['c'], 1e3 * thing['l']
    print(
        f'start      {_words(start)}, d {1e3 * start["d"]:.2f} mm',
        f'object     c {c:.2f} mm, mu_c {thing["mu_c"]:g}, l {l:.2f} mm',
        f'belt       {1e3 * content["belt"]:g} mm',
        sep='\n',
    )
    if 'goal' in content:
        told = content['goal']
        reason = f', {told["reason"]}' if told['reason'] else ''
        belt = '' if math.isnan(told['belt']) else f', {1e3 * told["belt"]:.0f} mm of belt'
        print(f'goal       {_words(told["goal"])}: {told["verdict"]}{reason}{belt}')
        if told['reason']:
            nearest = told['nearest']
            print(f'nearest    {_words(nearest) if nearest else "none found"}')
    if found is not None:
        goals = len(found.xs) * len(found.thetas)
        not_reached = ', '.join(
            f'{found.count(OUT_OF_REACH, reason)} {reason}'
            for reason in REASONS
            if found.count(OUT_OF_REACH, reason)
        )
        print(
            f'reached    {found.count(WITH_RESERVE)} of {goals} goals with reserve, '
            f'{found.count(AT_THE_LIMITS)} at the limits',
            f'not        {not_reached or "none"}',
            sep='\n',
        )


def _words(place: dict[str, float]) -> str:
    return f'x {1e3 * place["x"]:.1f} mm, theta {math.degrees(place["theta"]):.1f}°'
