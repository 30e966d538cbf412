# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The options of object and start, whose every value `simulate` tries."""

import argparse
import math

import pytest

from tactile_push.cli.pushed_object import add_object, add_start, config_of


def config(*words):
    parser = argparse.ArgumentParser()
    add_object(parser.add_argument)
    add_start(parser.add_argument)
    return config_of(parser.parse_args(words))


def test_without_options_it_is_the_start_of_figure_8():
    found = config()
    assert (math.degrees(found.theta), found.d, found.mu_c) == pytest.approx(
        (20.0, -6e-3, math.inf)
    )
    assert found.slider.c == pytest.approx(0.0187, abs=5e-5)
    assert not found.tip_turns


def test_options_say_what_is_pushed_and_where():
    found = config(
        *('--object', 'disk', '--support', 'rim', '--mu-c', '0.2', '--theta0-deg', '5'),
    )
    assert (math.degrees(found.theta), found.mu_c) == pytest.approx((5.0, 0.2))
    assert found.slider.c == pytest.approx(0.0285)  # all load at the radius
    assert found.d is None


def test_a_contact_beside_the_edge_is_refused():
    with pytest.raises(ValueError, match='d'):
        config('--d0-mm', '30')
