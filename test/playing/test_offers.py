# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Whoever was served by one of the recorded publishers is served by the player."""

import itertools

import pytest

rclpy = pytest.importorskip('rclpy')

from rclpy.duration import Duration  # noqa: E402
from rclpy.qos import (  # noqa: E402
    DurabilityPolicy,
    LivelinessPolicy,
    QoSCompatibility,
    QoSProfile,
    ReliabilityPolicy,
    qos_check_compatible,
)

from tactile_push.playing.offers import DEPTH, FOREVER, LATCHED_DEPTH, combined_offer  # noqa: E402
from tactile_push.playing.player import profile_of  # noqa: E402
from tactile_push.recording.recorder import qos_entry  # noqa: E402

MS = 10**6
PROFILES = [
    QoSProfile(
        depth=1,
        reliability=reliability,
        durability=durability,
        liveliness=liveliness,
        deadline=Duration(nanoseconds=deadline),
        lifespan=Duration(nanoseconds=FOREVER),
        liveliness_lease_duration=Duration(nanoseconds=lease),
    )
    for reliability in (ReliabilityPolicy.RELIABLE, ReliabilityPolicy.BEST_EFFORT)
    for durability in (DurabilityPolicy.VOLATILE, DurabilityPolicy.TRANSIENT_LOCAL)
    for liveliness in (LivelinessPolicy.AUTOMATIC, LivelinessPolicy.MANUAL_BY_TOPIC)
    for deadline, lease in ((FOREVER, FOREVER), (100 * MS, FOREVER), (FOREVER, 300 * MS))
]


def serves(publisher, subscriber):
    return qos_check_compatible(publisher, subscriber)[0] != QoSCompatibility.ERROR


def test_every_subscriber_of_any_publisher_is_served():
    refused = 0
    for publishers in itertools.combinations(PROFILES, 2):
        ours = profile_of(combined_offer([qos_entry(publisher) for publisher in publishers]))
        for subscriber in PROFILES:
            if any(serves(publisher, subscriber) for publisher in publishers):
                assert serves(ours, subscriber)
            else:
                refused += 1
    assert refused > 0


@pytest.mark.parametrize('profile', PROFILES, ids=str)
def test_single_publisher_is_offered_again(profile):
    offered = qos_entry(profile_of(combined_offer([qos_entry(profile)])))
    assert offered == qos_entry(profile)


def test_bag_without_offers_is_played_reliably():
    offer = combined_offer([])
    assert (offer.reliable, offer.latched, offer.manual, offer.unmangled) == (True,) + 3 * (False,)
    assert (offer.deadline, offer.lifespan, offer.lease) == (FOREVER,) * 3


def test_unknown_depth_is_a_deep_one():
    assert combined_offer([{'depth': 0}]).depth == DEPTH
    assert combined_offer([{'depth': 0, 'durability': 'transient_local'}]).depth == LATCHED_DEPTH
    assert combined_offer([{'depth': 7}, {'depth': 3}]).depth == 7


def test_numbers_of_older_bags_are_understood():
    # rmw/types.h: reliable 1, best effort 2; transient local 1, volatile 2; manual by topic 3.
    old = {'reliability': 2, 'durability': 1, 'liveliness': 3}
    new = {
        'reliability': 'best_effort',
        'durability': 'transient_local',
        'liveliness': 'manual_by_topic',
    }
    assert combined_offer([old]) == combined_offer([new])
    assert combined_offer([{'reliability': 1, 'durability': 2, 'liveliness': 1}]) == combined_offer(
        []
    )


def test_strictest_deadline_and_longest_lifespan():
    short, long = {'sec': 0, 'nsec': 100}, {'sec': 2, 'nsec': 1}
    none = {'sec': 0, 'nsec': 0}
    names = ('deadline', 'lifespan', 'liveliness_lease_duration')
    offer = combined_offer([dict.fromkeys(names, d) for d in (short, long)])
    assert (offer.deadline, offer.lifespan, offer.lease) == (100, 2 * 10**9 + 1, 100)
    offer = combined_offer([dict.fromkeys(names, d) for d in (short, none)])
    assert (offer.deadline, offer.lifespan, offer.lease) == (100, FOREVER, 100)


def test_name_is_the_middlewares_own_if_it_always_was():
    plain = {'avoid_ros_namespace_conventions': True}
    assert combined_offer([plain]).unmangled
    assert not combined_offer([plain, {}]).unmangled
