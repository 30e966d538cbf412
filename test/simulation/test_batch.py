# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import math
import signal
import subprocess
import sys
import tracemalloc

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support.expected import FIGURE_8_SETTLE_STEP, assert_is_end_of_figure_8, each_step_of_figure_8
from tactile_push.control import AHEAD, PushLaw, settle_step
from tactile_push.mechanics import FREE, MODES, STICK, Outline, Slider, Support
from tactile_push.simulation import RigConfig, Servo, paper_block, paper_disk, rollout, rollouts

checked = settings(derandomize=True, deadline=None, max_examples=30)
THETA_D = math.radians(-10.0)
LOWER, UPPER = math.radians(33.0), math.radians(147.0)
QUANTITIES = ('theta', 'phi', 'd', 'x', 'y', 'mode')
BLOCK = paper_block().slider
FIG_8 = {
    'theta': math.radians(20.0),
    'd': -0.006,
    'kp': 0.05,
    'kd': 5.0,
    'theta_desired': THETA_D,
    'steps': 600,
}


@pytest.fixture(scope='module')
def fig_8():
    """Return the step response of fig. 8 with kp = 0.05 and kd = 5."""
    return rollouts(BLOCK, **FIG_8, history=True)


@each_step_of_figure_8
def test_step_response_of_figure_8_in_a_batch(fig_8, k, theta, phi):
    assert math.degrees(fig_8.theta[0, k]) == pytest.approx(theta, abs=0.006)
    assert math.degrees(fig_8.phi[0, k]) == pytest.approx(phi, abs=0.06)


def test_step_response_of_figure_8_settles_and_translates_in_a_batch(fig_8):
    assert fig_8.settle_step.tolist() == [FIGURE_8_SETTLE_STEP]
    assert fig_8.steps.tolist() == [600]
    summary = rollouts(BLOCK, **FIG_8)
    assert summary.settle_step.tolist() == [FIGURE_8_SETTLE_STEP]
    assert_is_end_of_figure_8(summary.theta[0], summary.phi[0], summary.d[0])
    assert MODES[int(summary.mode[0])] == 'stick'


def test_gains_of_a_figure_come_in_one_batch():
    # Without derivative gain the block swings; the last value of each run is its own.
    many = rollouts(BLOCK, **{**FIG_8, 'kd': [5.0, 0.0, 2.0]}, history=True)
    for i, kd in enumerate((5.0, 0.0, 2.0)):
        one = rollout(paper_block(), PushLaw(0.05, kd, THETA_D), 600)
        steps = many.steps[i]
        assert np.array_equal(many.theta[i, : steps + 1], one.theta)
    assert np.ptp(many.theta[:, 100]) > 0.01


def corners_of(count, a, b, start):
    angle = start + np.arange(count) * 2.0 * math.pi / count
    return np.stack([a * np.cos(angle), b * np.sin(angle)], axis=1)


RECTANGLE = Outline.rectangle(0.05, 0.0475)
ELLIPSOIDS = [
    BLOCK,
    Slider(RECTANGLE, 0.0345),
    Slider(RECTANGLE, 0.0067),
    Slider(Outline.polygon(corners_of(3, 0.03, 0.02, -2.2)), 0.01),
    Slider(Outline.polygon(corners_of(5, 0.003, 0.004, -2.0)), 0.002),
    Slider(Outline.polygon([(-0.02, -0.01), (0.03, -0.02), (0.01, 0.02), (-0.03, 0.02)]), 0.015),
    Slider(Outline.ellipse(0.02, 0.03), 0.013),
    paper_disk().slider,
]
EXACT = [
    Slider.on(RECTANGLE, Support.corners(RECTANGLE), exact=True),
    Slider.on(RECTANGLE, Support.uniform(RECTANGLE, 20), exact=True),
    Slider.on(
        Outline.polygon([(-0.02, -0.01), (0.03, -0.02), (0.01, 0.02), (-0.03, 0.02)]),
        Support.at_points([(0.0, 0.0), (0.01, 0.0), (0.0, 0.01)], [1.0, 2.0, 1.5]),
        exact=True,
    ),
    Slider.on(Outline.circle(0.02), Support.rim(Outline.circle(0.02), 9), exact=True),
    Slider.on(Outline.ellipse(0.02, 0.03), Support.circle(0.01, count=12), exact=True),
]


def first_contacts(slider):
    """Return the range of d where the first piece of the outline touches."""
    x, y, tau, length, turn = slider.outline.pieces[0]
    start = x * math.cos(tau) + y * math.sin(tau)
    return (start, start + length) if turn == 0.0 else (start, start)


@st.composite
def runs(draw, sliders):
    """Draw the arguments of one run."""
    slider = draw(st.sampled_from(sliders))
    lower, upper = first_contacts(slider)
    return {
        'slider': slider,
        'theta': draw(st.floats(-0.5, 0.5)),
        'd': lower + draw(st.floats(0.0, 1.0)) * (upper - lower),
        'phi': draw(st.floats(1.0, math.pi - 1.0)),
        'mu_c': draw(st.sampled_from([0.0, 0.15, 0.5, 2.0, math.inf])),
        'kp': draw(st.sampled_from([0.0, 0.02, 0.05])),
        'kd': draw(st.sampled_from([0.0, 2.0, 5.0])),
        'theta_desired': draw(st.floats(-0.3, 0.3)),
        'phi_min': draw(st.sampled_from([LOWER, 0.9])),
        'phi_max': draw(st.sampled_from([UPPER, 2.2])),
    }


def single(run, steps, **settings):
    """Make one run of a batch by itself."""
    law = PushLaw(run['kp'], run['kd'], run['theta_desired'], run['phi_min'], run['phi_max'])
    law.phi = run['phi']
    config = RigConfig(run['slider'], run['mu_c'], run['theta'], run['d'], tip_turns=False)
    return rollout(config, law, steps, **settings)


def assert_batch_is_its_runs(batch, steps):
    arguments = {name: [run[name] for run in batch] for name in batch[0]}
    band = 0.1
    histories = rollouts(**arguments, steps=steps, band=band, history=True)
    summaries = rollouts(**arguments, steps=steps, band=band)
    for i, run in enumerate(batch):
        one = single(run, steps)
        last = len(one.theta) - 1
        assert histories.steps[i] == summaries.steps[i] == last
        settled = settle_step(one.theta, run['theta_desired'], band) if last == steps else None
        settled = -1 if settled is None else settled
        assert histories.settle_step[i] == summaries.settle_step[i] == settled
        for name in QUANTITIES:
            history, summary = getattr(histories, name), getattr(summaries, name)
            assert history.shape == (len(batch), steps + 1)
            assert summary.shape == (len(batch),)
            assert history[i, : last + 1] == pytest.approx(getattr(one, name), abs=1e-12)
            assert np.all(np.isnan(history[i, last + 1 :]))
            assert summary[i] == history[i, last]


@pytest.mark.slow
@checked
@given(st.lists(runs(ELLIPSOIDS), min_size=1, max_size=8))
def test_each_run_of_a_batch_is_a_rollout(batch):
    assert_batch_is_its_runs(batch, 150)


@settings(checked, max_examples=15)
@given(st.lists(runs(EXACT), min_size=1, max_size=4))
def test_each_run_of_a_batch_on_exact_supports_is_a_rollout(batch):
    assert_batch_is_its_runs(batch, 10)


TILTED = [
    Slider.on(RECTANGLE, Support.corners(RECTANGLE), exact=True, tilt=3e-3),
    Slider.on(RECTANGLE, Support.uniform(RECTANGLE, 20), exact=True, tilt=1e-3),
]


@settings(checked, max_examples=5)
@given(st.lists(runs(TILTED), min_size=1, max_size=3))
def test_each_run_of_a_batch_above_the_support_is_a_rollout(batch):
    assert_batch_is_its_runs(batch, 10)


def test_a_batch_with_and_without_a_tilt_is_refused():
    with pytest.raises(ValueError, match='^slider: expected all with a tilt or all without'):
        rollouts([EXACT[0], TILTED[0]], theta=np.zeros(2), d=np.zeros(2), steps=1)


def test_large_batch_on_all_cores_is_its_runs_in_their_order():
    # Many more runs than cores and chunks, no two alike.
    count = 1003
    rng = np.random.default_rng(1992)
    which = rng.integers(0, len(ELLIPSOIDS), count)
    span = np.array([first_contacts(slider) for slider in ELLIPSOIDS])[which]
    arguments = {
        'slider': [ELLIPSOIDS[i] for i in which],
        'theta': rng.uniform(-0.5, 0.5, count),
        'd': span[:, 0] + rng.random(count) * (span[:, 1] - span[:, 0]),
        'phi': rng.uniform(1.0, 2.1, count),
        'mu_c': rng.choice([0.0, 0.3, math.inf], count),
        'kp': rng.uniform(0.0, 0.1, count),
        'kd': rng.uniform(0.0, 5.0, count),
        'theta_desired': rng.uniform(-0.3, 0.3, count),
        'phi_min': np.full(count, LOWER),
        'phi_max': np.full(count, UPPER),
    }
    found = rollouts(**arguments, steps=20)
    assert len(set(found.x.tolist())) == count
    for i in range(count):
        one = single({name: values[i] for name, values in arguments.items()}, 20)
        assert found.steps[i] == len(one.theta) - 1
        for name in QUANTITIES:
            assert getattr(found, name)[i] == pytest.approx(getattr(one, name)[-1], abs=1e-12)


def test_same_batch_gives_the_same_bits():
    d = np.linspace(-0.024, 0.024, 200)
    first, second = (
        rollouts(BLOCK, theta=0.1, d=d, mu_c=0.3, kp=0.05, kd=5.0, steps=50) for _ in range(2)
    )
    for name in (*QUANTITIES, 'steps', 'settle_step'):
        assert np.array_equal(getattr(first, name), getattr(second, name))


def test_without_gains_the_batch_is_open_loop():
    phi = np.array([1.2, AHEAD, 2.0])
    many = rollouts(BLOCK, theta=0.1, phi=phi, mu_c=0.3, steps=40, history=True)
    for i in range(3):
        one = rollout(paper_block(0.1, 0.0, mu_c=0.3), phi[i], 40)
        assert np.all(many.phi[i] == phi[i])
        for name in QUANTITIES:
            assert np.array_equal(getattr(many, name)[i], getattr(one, name))


def test_period_belt_speed_and_radius_are_those_of_all_runs():
    arguments = {'theta': 0.2, 'd': -0.004, 'mu_c': 0.2, 'kp': 0.05, 'kd': 5.0, 'steps': 30}
    found = rollouts(BLOCK, **arguments, period=0.07, belt_speed=0.011, radius=0.006, history=True)
    config = RigConfig(BLOCK, 0.2, 0.2, -0.004, belt_speed=0.011, radius=0.006, tip_turns=False)
    one = rollout(config, PushLaw(0.05, 5.0, 0.0), 30, period=0.07)
    for name in QUANTITIES:
        assert np.array_equal(getattr(found, name)[0], getattr(one, name))


def test_numbers_alone_are_a_batch_of_one():
    found = rollouts(BLOCK, theta=0.1, steps=3)
    for name in (*QUANTITIES, 'steps', 'settle_step'):
        assert getattr(found, name).shape == (1,)
    assert rollouts(BLOCK, theta=0.1, steps=3, history=True).theta.shape == (1, 4)


def test_arguments_are_broadcast_against_each_other_and_the_sliders():
    two = [BLOCK, ELLIPSOIDS[1]]
    found = rollouts(two, theta=0.1, d=[-0.005], mu_c=[0.0, math.inf], steps=20)
    for i, mu_c in enumerate((0.0, math.inf)):
        one = rollout(RigConfig(two[i], mu_c, 0.1, -0.005, tip_turns=False), AHEAD, 20)
        assert found.theta[i] == one.theta[-1]
    alike = rollouts([BLOCK], theta=[0.1, 0.1, 0.2], steps=20)
    assert alike.theta.shape == (3,)
    assert alike.theta[0] == alike.theta[1] != alike.theta[2]
    many = rollouts([BLOCK] * 4, theta=0.1, steps=20)
    assert many.theta.tolist() == [alike.theta[0]] * 4


def test_no_steps_give_the_starts():
    for history in (False, True):
        found = rollouts(BLOCK, theta=[0.1, -0.2], d=[0.001, 0.002], steps=0, history=history)
        assert found.theta.ravel() == pytest.approx([0.1, -0.2])
        assert found.d.ravel() == pytest.approx([0.001, 0.002])
        assert np.all(found.phi == AHEAD)
        assert np.all(found.mode == FREE)
        assert found.steps.tolist() == [0, 0]
        assert found.settle_step.tolist() == [-1, -1]  # 5.7 and 11.5 degrees off


def test_lost_contact_ends_its_run_alone():
    small = Slider(Outline.polygon(corners_of(5, 0.003, 0.004, -2.0)), 0.002)
    gains = {'kp': [0.0, 0.05], 'kd': [0.0, 5.0]}
    found = rollouts([small, BLOCK], theta=-0.4, mu_c=[0.1, math.inf], **gains, steps=400)
    assert 0 < found.steps[0] < 400
    assert found.steps[1] == 400
    assert found.mode.tolist() == [FREE, STICK]
    assert found.settle_step[0] == -1
    assert np.all(np.isfinite([getattr(found, name) for name in QUANTITIES]))


@checked
@given(
    band=st.floats(0.0, 0.3),
    theta=st.lists(st.floats(-0.4, 0.4), min_size=1, max_size=5),
    theta_desired=st.floats(-0.3, 0.3),
    kd=st.floats(0.0, 6.0),
)
def test_settle_step_is_that_of_the_control(band, theta, theta_desired, kd):
    found = rollouts(
        BLOCK,
        theta=theta,
        kp=0.05,
        kd=kd,
        theta_desired=theta_desired,
        steps=120,
        band=band,
        history=True,
    )
    for i, steps in enumerate(found.steps):
        expected = settle_step(found.theta[i], theta_desired, band) if steps == 120 else None
        assert found.settle_step[i] == (-1 if expected is None else expected)


def test_mirrored_batches_mirror():
    rng = np.random.default_rng(7)
    theta, d = rng.uniform(-0.5, 0.5, 50), rng.uniform(-0.024, 0.024, 50)
    phi, desired = rng.uniform(1.1, 2.0, 50), rng.uniform(-0.3, 0.3, 50)
    same = {'mu_c': rng.choice([0.0, 0.3, math.inf], 50), 'kp': 0.05, 'kd': 5.0, 'steps': 100}
    one = rollouts(BLOCK, theta=theta, d=d, phi=phi, theta_desired=desired, **same)
    other = rollouts(BLOCK, theta=-theta, d=-d, phi=math.pi - phi, theta_desired=-desired, **same)
    assert np.array_equal(other.steps, one.steps)
    assert other.theta == pytest.approx(-one.theta, abs=1e-6)
    assert other.phi - AHEAD == pytest.approx(AHEAD - one.phi, abs=1e-5)
    assert other.d == pytest.approx(-one.d, abs=1e-7)
    assert (other.x, other.y) == (
        pytest.approx(-one.x, abs=1e-7),
        pytest.approx(one.y, abs=1e-7),
    )


def peak_memory(**arguments):
    """Return the greatest memory in use during a batch and that of its result [bytes]."""
    rollouts(**{**arguments, 'steps': 1})  # compiles
    tracemalloc.start()
    try:
        found = rollouts(**arguments)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    return peak, 8 * sum(np.size(getattr(found, name)) for name in QUANTITIES)


def test_memory_of_summaries_does_not_grow_with_the_steps():
    arguments = {'slider': BLOCK, 'theta': np.full(100, 0.1), 'kp': 0.05, 'kd': 5.0}
    few, size = peak_memory(**arguments, steps=3)
    many, same_size = peak_memory(**arguments, steps=60)
    assert size == same_size == 100 * 6 * 8
    # Histories of 60 steps take 270 kB more than those of 3.
    assert many < few + 20_000


def test_memory_of_histories_is_that_of_what_is_returned():
    arguments = {'slider': BLOCK, 'theta': np.full(100, 0.1), 'history': True}
    peak, size = peak_memory(**arguments, steps=60)
    assert size == 100 * 61 * 6 * 8
    assert size < peak < size + 100_000


@pytest.mark.parametrize(
    ('name', 'value', 'shown'),
    [
        ('theta', math.nan, 'nan'),
        ('theta', [0.1, math.inf], 'inf'),
        ('d', math.nan, 'nan'),
        ('d', 0.0251, '0.0251'),
        ('d', [0.0, -0.03], '-0.03'),
        ('phi', math.nan, 'nan'),
        ('phi', 0.0, '0.0'),
        ('phi', math.pi, '3.14159'),
        ('phi', [1.5, -1.0], '-1.0'),
        ('phi', 0.1, '0.1'),
        ('mu_c', -0.1, '-0.1'),
        ('mu_c', [math.inf, math.nan], 'nan'),
        ('kp', math.nan, 'nan'),
        ('kd', math.inf, 'inf'),
        ('theta_desired', [math.nan], 'nan'),
        ('phi_min', 0.0, '0.0'),
        ('phi_max', 4.0, '4.0'),
        ('steps', -1, '-1'),
        ('period', 0.0, '0.0'),
        ('period', math.nan, 'nan'),
        ('belt_speed', 0.0, '0.0'),
        ('belt_speed', math.inf, 'inf'),
        ('radius', -0.01, '-0.01'),
        ('radius', math.nan, 'nan'),
        ('band', math.nan, 'nan'),
        ('band', -0.1, '-0.1'),
        ('slider', [], ''),
        ('slider', [BLOCK, EXACT[0]], ''),
    ],
)
def test_argument_out_of_its_range_is_refused_by_name_and_value(name, value, shown):
    good = {'slider': BLOCK, 'theta': 0.2, 'steps': 3}
    assert rollouts(**good).theta.shape == (1,)
    with pytest.raises(ValueError, match=f'^{name}: expected .*{shown}'):
        rollouts(**{**good, name: value})


@pytest.mark.parametrize(
    'arguments',
    [
        {'theta': [0.1, 0.2, 0.3], 'd': [0.0, 0.001]},
        {'theta': [0.1, 0.2], 'mu_c': [0.0, 0.1, 0.2]},
        {'theta': [0.1, 0.2], 'slider': [BLOCK] * 3},
        {'theta': [[0.1, 0.2]]},
        {'theta': 0.1, 'kd': [[5.0], [2.0]]},
        {'theta': []},
    ],
)
def test_shapes_that_do_not_fit_are_refused_by_name_and_shape(arguments):
    with pytest.raises(ValueError, match='expected') as refused:
        rollouts(**{'slider': BLOCK, **arguments}, steps=3)
    for name, value in arguments.items():
        if np.shape(value) and name != 'slider':
            assert f'{name} {np.shape(value)}' in str(refused.value)


INTERRUPTED = """
import threading, time
import numpy as np
from tactile_push.simulation import paper_block, rollouts

def tell():
    while threading.active_count() == idle:
        time.sleep(0.01)
    print('running', flush=True)

def push(count, steps):
    theta = np.full(count, 0.1)
    rollouts(paper_block().slider, theta=theta, kp=0.05, kd=5.0, steps=steps)

push(1, 1)  # compiles
idle = threading.active_count() + 1
threading.Thread(target=tell, daemon=True).start()
push(200_000, 5_000)  # takes minutes if it may
"""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == 'win32', reason='there is no SIGINT')
def test_ctrl_c_ends_a_long_batch():
    child = subprocess.Popen(
        [sys.executable, '-c', INTERRUPTED],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        # A shell's background processes ignore it.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    with child:
        try:
            assert child.stdout.readline() == 'running\n'
            child.send_signal(signal.SIGINT)
            child.wait(timeout=10.0)
            assert 'KeyboardInterrupt' in child.stderr.read()
        finally:
            child.kill()
    assert child.returncode != 0


@pytest.mark.parametrize(
    'bounds', [{'phi_min': 2.0, 'phi_max': 1.0}, {'phi': 0.3}, {'phi_max': 1.5}]
)
def test_a_first_push_beyond_the_bounds_is_refused(bounds):
    with pytest.raises(ValueError, match='phi: expected phi_min to phi_max'):
        rollouts(paper_block().slider, theta=0.1, steps=2, **bounds)


def test_servos_of_a_batch_are_those_of_its_rollouts():
    servos = [Servo(), Servo(0.1), Servo(0.05, 0.23), Servo(delay=0.3), Servo(0.1, 0.1, 1e-4)]
    many = rollouts(BLOCK, **FIG_8, mu_c=0.3, servo=servos, history=True)
    for i, servo in enumerate(servos):
        law = PushLaw(0.05, 5.0, THETA_D)
        one = rollout(paper_block(mu_c=0.3), law, 600, servo=servo)
        for name in QUANTITIES:
            assert np.array_equal(getattr(many, name)[i], getattr(one, name)), name
        assert many.settle_step[i] == settle_step(one.theta, THETA_D, math.radians(3.0))


def test_one_servo_is_for_all_and_several_are_broadcast():
    gains = [0.02, 0.05]
    one = rollouts(BLOCK, **FIG_8 | {'kp': gains}, servo=Servo(0.1))
    two = rollouts(BLOCK, **FIG_8 | {'kp': gains}, servo=[Servo(0.1), Servo(0.1)])
    assert np.array_equal(one.theta, two.theta)
    assert one.theta[0] != one.theta[1]
    with pytest.raises(ValueError, match=r'servo.time_constant \(3,\)'):
        rollouts(BLOCK, **FIG_8 | {'kp': gains}, servo=[Servo()] * 3)
