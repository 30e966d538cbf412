# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What `wrench_sensor` believes by its parameters."""

import pytest

from tactile_push.parameters import WrenchSensorParameters
from tactile_push.parameters.wrench_sensor import wrench_sensing

# Each number that may change while the node runs, and where it has to arrive.
VALUES = {
    'tip_radius': (0.02, 'radius'),
    'reaction': (True, 'reaction'),
    'contact_force': (0.5, 'contact_force'),
    'release_force': (0.05, 'release_force'),
    'filter_time_constant': (0.1, 'time_constant'),
    'max_torsion': (0.01, 'max_torsion'),
    'max_gap': (0.02, 'max_gap'),
    'max_rate': (50.0, 'max_rate'),
    'force_range': (70.0, 'force_range'),
    'moment_range': (2.0, 'moment_range'),
    'tare_time': (1.0, 'tare_time'),
}
FIXED = {'tip_xyz': ([0.01, 0.0, 0.03], 'xyz'), 'tip_rpy': ([0.1, 0.0, 3.0], 'rpy')}
OF_THE_NODE = {'silence_timeout'}


def test_every_number_that_may_change_is_tested_here():
    changeable = {p.name for p in WrenchSensorParameters.declared() if not p.read_only}
    assert changeable == set(VALUES) | OF_THE_NODE


@pytest.mark.parametrize('name', [*VALUES, *FIXED])
def test_each_number_arrives(name):
    value, place = (VALUES | FIXED)[name]
    arrived = getattr(wrench_sensing(WrenchSensorParameters(**{name: value})), place)
    assert (list(arrived) if isinstance(value, list) else arrived) == value
    assert getattr(wrench_sensing(WrenchSensorParameters()), place) != arrived


@pytest.mark.parametrize(
    ('given', 'words'),
    [
        ({'tip_xyz': [0.0, 0.02]}, r'tip_xyz: expected three finite numbers, got \[0'),
        ({'tip_rpy': []}, 'tip_rpy: expected three finite numbers'),
        ({'release_force': 0.3}, 'release_force: expected a positive force up to'),
    ],
)
def test_numbers_that_do_not_fit_are_refused_by_the_parameters_name(given, words):
    with pytest.raises(ValueError, match=words):
        wrench_sensing(WrenchSensorParameters(**given))
