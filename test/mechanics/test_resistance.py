# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

from tactile_push.estimation import edges_of
from tactile_push.estimation.hypotheses import advance
from tactile_push.estimation.prior import ROUND
from tactile_push.mechanics import (
    ExactLimitSurface,
    Outline,
    Slider,
    Support,
    sticking_twist,
)
from tactile_push.mechanics.resistance import Pressure, Push, cone_of_angle, resistance, settled
from tactile_push.simulation import Rig, RigConfig

RADIUS = 0.0135
BLOCK = [(-0.025, -0.02375), (0.025, -0.02375), (0.025, 0.02375), (-0.025, 0.02375)]
PLATE = [(-0.04, -0.01), (0.04, -0.01), (0.04, 0.01), (-0.04, 0.01)]
TRIANGLE = [(-0.03, -0.015), (0.04, -0.02), (-0.01, 0.035)]
MOMENTS = np.array(ROUND)


def measured(corners, velocity, rate):
    """Give c^2 under uniform pressure: (m/f)/(omega/|v|) from the friction at all points."""
    surface = ExactLimitSurface(Support.uniform(Outline.polygon(corners), 400))
    f_x, f_y, m = surface.wrench([*velocity, rate])
    return m / math.hypot(f_x, f_y) * math.hypot(*velocity) / rate


@pytest.mark.parametrize('corners', [BLOCK, PLATE, TRIANGLE])
def test_an_object_that_hardly_turns_resists_by_the_load_along_its_way(corners):
    edge = edges_of(corners)[0]
    # The moments of a uniform plate about its centre of mass, by the sums over its triangles.
    points, areas = [], []
    for a, b in zip(corners, corners[1:] + corners[:1], strict=True):
        triangle = np.array([(0.0, 0.0), a, b])
        for one, two in ((0, 1), (1, 2), (2, 0)):
            points.append((triangle[one] + triangle[two]) / 2.0)  # exact for squares
            areas.append((a[0] * b[1] - a[1] * b[0]) / 6.0)
    points, areas = np.array(points), np.array(areas)
    tensor = (points.T * areas) @ points / areas.sum()
    c_squared = math.sqrt(np.linalg.det(tensor))
    for angle in (0.0, 0.6, 1.5, 2.5):
        direction = np.array([math.sin(angle), math.cos(angle)])
        turn = np.array(
            [
                [math.cos(edge.angle), -math.sin(edge.angle)],
                [math.sin(edge.angle), math.cos(edge.angle)],
            ]
        )
        expected = measured(corners, turn @ direction, 1e-3)

        found = resistance(*direction, 1e-3, Pressure(c_squared, 1.9, 1.0, np.array(edge.moments)))

        assert found == pytest.approx(expected, rel=0.02)


def test_growth_is_that_of_a_block_under_uniform_pressure():
    # As far as a push can turn it, for its centre moves with more than half of the finger's way.
    still = measured(BLOCK, (0.0, 1.0), 1e-3)
    for rate in (10.0, 25.0, 50.0, 75.0):
        grown = resistance(0.0, 1.0, rate, Pressure(still, 1.9, 0.0, MOMENTS))
        assert grown == pytest.approx(measured(BLOCK, (0.0, 1.0), rate), rel=0.06)


def test_without_growth_and_shape_it_is_an_ellipsoid():
    pressure = Pressure(2e-4, 0.0, 0.0, np.array([4.0, 0.0, 0.25]))
    assert resistance(0.3, 1.0, 40.0, pressure) == 2e-4


@pytest.mark.parametrize('tilt', [0.0, 0.004])
@pytest.mark.parametrize('mu_c', [0.0, 0.3, math.inf])
def test_motion_and_resistance_agree(mu_c, tilt):
    rng = np.random.default_rng(3)
    moments = np.array(edges_of(PLATE)[0].moments)
    for _ in range(100):
        v_t, d, l = rng.uniform(-0.003, 0.003), rng.uniform(-0.02, 0.02), 0.02
        c_squared, growth, shape = rng.uniform(0.01, 0.03) ** 2, rng.uniform(0.0, 3.0), 0.3
        cone = cone_of_angle(math.atan(mu_c))

        pressure = Pressure(c_squared, growth, shape, moments, tilt)
        now, d_s, l_s, omega, v_slip = settled(v_t, 0.005, d, l, *cone, pressure)

        v_ct, v_cn = v_t - v_slip - l_s * omega, 0.005 - d_s * omega  # of the centre of friction
        found = resistance(v_ct, v_cn, omega, pressure)
        assert now == pytest.approx(found, rel=0.1)
        # It is shifted along the force, by tilt |f| / f_max of the ellipsoid.
        speed = math.hypot(v_ct, v_cn)
        shift = tilt * np.array([v_ct, v_cn]) / math.hypot(speed, math.sqrt(now) * omega)
        assert (d - d_s, l_s - l) == pytest.approx(shift, rel=0, abs=0.03 * tilt)
        if v_slip == 0.0:
            expected = sticking_twist(v_t, 0.005, d_s, -l_s, math.sqrt(now))[2]
        else:  # the force is that of the cone's edge, and the centre of mass goes with it
            side = math.copysign(mu_c, v_slip)
            assert v_ct == pytest.approx(side * v_cn, abs=1e-9)
            expected = (d + l * side) * v_cn / now
        assert omega == pytest.approx(expected, rel=1e-6, abs=1e-9)


@pytest.mark.parametrize(
    ('tilt', 'most_degrees', 'most_millimetres', 'untold'),
    [(0.0, 0.15, 0.1, 0.0), (0.002, 0.15, 0.2, 0.5), (0.004, 0.4, 0.4, 1.0)],
)
def test_a_block_under_uniform_pressure_is_followed_through_a_long_slip(
    tilt, most_degrees, most_millimetres, untold
):
    # Without friction the contact slips by 15 mm along the edge while the block turns by 18
    # degrees. No ellipsoid's c comes near.
    outline = Outline.polygon(BLOCK)
    slider = Slider.on(outline, Support.uniform(outline, 100), exact=True, tilt=tilt)
    start, v_x = (0.18, 0.0199), -0.0035
    rig = Rig(RigConfig(slider, 0.0, *start, radius=RADIUS, tip_turns=False))
    truth = [start]
    for _ in range(21):
        rig.step(v_x, 0.1)
        truth.append((rig.theta, rig.d))
    truth = np.array(truth)

    def worst(c, growth, tilt):
        """Give the largest errors of theta [degrees] and d [mm]."""
        now, rows = start, []
        for _ in truth:
            rows.append(now)
            for _ in range(4):
                now = advance(
                    *(*now, 0.0, 0.02375, RADIUS, Pressure(c * c, growth, 0.0, MOMENTS, tilt)),
                    *(Push(v_x, 0.005, 0.025), False),
                )[:2]
        errors = np.abs(np.array(rows) - truth).max(axis=0)
        return math.degrees(errors[0]), 1e3 * errors[1]

    still = math.sqrt(measured(BLOCK, (0.0, 1.0), 1e-3))
    of_theta, of_d = worst(still, 1.9, tilt)
    assert of_theta < most_degrees
    assert of_d < most_millimetres
    assert min(worst(c, 0.0, tilt)[0] for c in np.linspace(0.01, 0.025, 31)) > 0.5
    # The shift moves the contact by so much for every radian.
    assert worst(still, 1.9, 0.0)[1] > untold
