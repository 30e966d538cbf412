# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What became of a reading, as numbers with names."""

import math

from tactile_push.interface import GEOMETRY_STATE, TOPICS
from tactile_push.tactile import REFUSALS, Reading, reading_values


def test_every_number_stands_under_its_name():
    values = reading_values(Reading(0.1, 1.4), 0.3, 0.2, '')
    assert tuple(values) == TOPICS[GEOMETRY_STATE].field_names
    assert values == {
        **{'azimuth': 0.1, 'elevation': 1.4, 'joint_angle': 0.3, 'theta': 0.2, 'refusal': 0.0}
    }


def test_every_refusal_has_its_number():
    numbers = []
    for refusal in REFUSALS:
        values = reading_values(Reading(0.1, 1.4), math.nan, math.nan, refusal)
        assert math.isnan(values['joint_angle'])
        assert math.isnan(values['theta'])
        numbers.append(values['refusal'])
    assert numbers == [float(number) for number in range(len(REFUSALS))]
