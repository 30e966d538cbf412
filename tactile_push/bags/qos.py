# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Qualities of service as bags note them: in rosbag2's words, in its older numbers, or by hand."""

from collections.abc import Callable, Mapping
from typing import Any

from tactile_push.bags.bag_files import load_yaml

# Words by their numbers in rmw/types.h, which rosbag2 wrote before Jazzy.
_WORDS = {
    'history': ('system_default', 'keep_last', 'keep_all', 'unknown'),
    'reliability': ('system_default', 'reliable', 'best_effort', 'unknown', 'best_available'),
    'durability': ('system_default', 'transient_local', 'volatile', 'unknown', 'best_available'),
    'liveliness': (
        *('system_default', 'automatic', 'manual_by_node', 'manual_by_topic', 'unknown'),
        'best_available',
    ),
}
_DURATIONS = ('deadline', 'lifespan', 'liveliness_lease_duration')
_DEEPEST = 2**31 - 1  # messages, as the middleware counts them
_SHOWN = 60  # characters of what is not understood


def read_profiles(text: str, warn: Callable[[str], None]) -> tuple[dict[str, Any], ...]:
    """Return the quality of service of each publisher of a topic, by the words of rosbag2.

    `warn` gets a line about each entry of another shape, which is left out.
    """
    try:
        profiles = load_yaml(text) or []
        if not isinstance(profiles, list) or not all(isinstance(one, dict) for one in profiles):
            raise ValueError('expected a list of mappings')
    except ValueError as error:
        warn(f'not used: {error}')
        return ()
    return tuple(_sound(profile, warn) for profile in profiles)


def _sound(profile: Mapping[Any, Any], warn: Callable[[str], None]) -> dict[str, Any]:
    sound = {}
    for key, value in profile.items():
        if expected := _expected(key, value):
            warn(f'{key}: expected {expected}, got {str(value)[:_SHOWN]!r}; the default is used')
        else:
            sound[key] = value
    return sound


def _expected(key: Any, value: Any) -> str:
    """Return what the value of an entry should be, '' if it will do."""
    if key in _WORDS:
        words = _WORDS[key]
        will_do = value in words or (type(value) is int and 0 <= value < len(words))
        return '' if will_do else f'one of {", ".join(words)}'
    if key in _DURATIONS:
        will_do = isinstance(value, dict) and bool(value) and {*value} <= {'sec', 'nsec'}
        will_do = will_do and all(type(part) is int and part >= 0 for part in value.values())
        return '' if will_do else 'sec and nsec'
    if key == 'depth':
        will_do = type(value) is int and 0 <= value <= _DEEPEST
        return '' if will_do else f'a whole number from 0 to {_DEEPEST}'
    if key == 'avoid_ros_namespace_conventions':
        return '' if isinstance(value, bool) else 'true or false'
    return '' if isinstance(key, str) and isinstance(value, str | int | float) else 'plain entries'
