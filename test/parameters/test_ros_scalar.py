# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Values of a parameter file: what is a number, and which."""

import math

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from tactile_push.parameters.ros_file import read_sections

TEXTS = st.text('0123456789abcdefxXpPeE+-._ ', min_size=1, max_size=12)
WORDS = st.sampled_from(
    [
        'inf',
        'nan',
        'infinity',
        '.inf',
        '+.Inf',
        '-.INF',
        '.NaN',
        '-.nan',
        'nan(1)',
        'YES',
        'On',
        '~',
    ]
)
SIGNED = st.builds(str.__add__, st.sampled_from(['', '+', '-', '0', '0x', '00']), TEXTS | WORDS)
NUMBERS = st.one_of(st.integers(-(2**65), 2**65).map(str), st.floats().map(str))


def read(file, texts):
    """Return the values of texts, as they stand in a file."""
    lines = ''.join(f'    p{k}: {text}\n' for k, text in enumerate(texts))
    file.write_text(f'/**:\n  ros__parameters:\n{lines}')
    return list(read_sections(file)['/**'].values())


def same(one, other):
    """Compare values and their types, NaN with NaN."""
    if isinstance(one, float) and isinstance(other, float) and math.isnan(one):
        return math.isnan(other)
    return type(one) is type(other) and one == other


@pytest.mark.parametrize(
    ('text', 'value'),
    [
        ('5e-3', 0.005),
        ('1e2', 100.0),
        ('1.', 1.0),
        ('.5', 0.5),
        ('inf', math.inf),
        ('-Infinity', -math.inf),
        ('.inf', math.inf),
        ('-.INF', -math.inf),
        ('.nan', math.nan),
        ('nan', math.nan),
        ('0x10', 16),
        ('-0x10', -16),
        ('010', 8),
        ('08', 8.0),
        ('0x1p-1', 0.5),
        ('9223372036854775807', 2**63 - 1),
        ('9223372036854775808', 2.0**63),
        ('1e999', '1e999'),
        ('1e-310', '1e-310'),
        ('1_0.0', '1_0.0'),
        ('1,5', '1,5'),
        ('1:30', '1:30'),
        ('0b1', '0b1'),
        ('2001-01-01', '2001-01-01'),
        ('"1.0"', '1.0'),
        ("'yes'", 'yes'),
        ('!!str 1.0', '1.0'),
        ('yes', True),
        ('Off', False),
        ('oN', 'oN'),
        ('null', 'null'),
        ('""', ''),
    ],
)
def test_value_is_what_c_makes_of_it(tmp_path, text, value):
    (found,) = read(tmp_path / 'one.yaml', [text])
    assert same(found, value)


@settings(derandomize=True, deadline=None, max_examples=5)
@given(st.lists(st.one_of(SIGNED, NUMBERS, WORDS), min_size=200, max_size=400))
@example(['-9223372036854775808', '-9223372036854775809', '1e308', '1e309', '-1e309', '+.5', '-0'])
@example(['2.2250738585072014e-308', '1e-400', '0e-400', '0x0p-9999', '5e-324', '.e1', '0x.8p1'])
def test_every_value_is_the_one_that_a_node_reads(tmp_path_factory, texts):
    pytest.importorskip('rclpy')
    from support.params_file import given_to, node_with, private_context

    # What is no scalar of YAML in such a place.
    texts = [text.strip() for text in texts]
    texts = [text for text in texts if text not in ('', '-', '.', '---') and text[:2] != '- ']
    file = tmp_path_factory.mktemp('values') / 'many.yaml'
    values = read(file, texts)
    with private_context() as context:
        node = node_with(context, file, 'any')
        given = list(given_to(node).values())
        node.destroy_node()
    assert len(values) == len(given) == len(texts)
    differ = [found for found in zip(texts, values, given, strict=True) if not same(*found[1:])]
    assert differ == []
