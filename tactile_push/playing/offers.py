# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The quality of service that one publisher offers in place of several recorded ones."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

FOREVER = 2**63 - 1  # [ns]

# The graph, and so a bag, does not know how many messages a publisher keeps. Ours keep 1000. Each
# late subscriber gets all that is latched, so there it is fewer; picked.
DEPTH = 1000
LATCHED_DEPTH = 100


@dataclass(frozen=True)
class Offer:
    """A quality of service, as far as it decides which subscribers are served and how."""

    reliable: bool  # lost messages are sent again
    latched: bool  # late subscribers get earlier messages (`transient_local`)
    manual: bool  # only publishing shows that the publisher lives (`manual_by_topic`)
    depth: int  # messages kept for slow or late subscribers
    deadline: int  # longest time between messages [ns]; FOREVER if unbounded, as for the next two
    lifespan: int  # for which a message is of use [ns]
    lease: int  # within which the publisher shows that it lives [ns]
    unmangled: bool  # the topic's name is the middleware's own


def combined_offer(offers: Sequence[Mapping[str, Any]]) -> Offer:
    """Return an offer that serves every subscriber that any of the recorded publishers served.

    `offers` is what a bag says of the publishers of a topic, in rosbag2's words or in the numbers
    that it wrote before Jazzy. In each respect the strongest one counts; of lifespans the longest.
    Without any, the offer is reliable.
    """
    latched = any(offer.get('durability') in ('transient_local', 1) for offer in offers)
    depth = LATCHED_DEPTH if latched else DEPTH
    return Offer(
        reliable=not offers
        or any(offer.get('reliability') not in ('best_effort', 2) for offer in offers),
        latched=latched,
        manual=any(offer.get('liveliness') in ('manual_by_topic', 3) for offer in offers),
        depth=max((offer.get('depth', 0) for offer in offers), default=0) or depth,
        deadline=min((_duration(offer, 'deadline') for offer in offers), default=FOREVER),
        lifespan=max((_duration(offer, 'lifespan') for offer in offers), default=FOREVER),
        lease=min(
            (_duration(offer, 'liveliness_lease_duration') for offer in offers), default=FOREVER
        ),
        unmangled=bool(offers)
        and all(offer.get('avoid_ros_namespace_conventions', False) for offer in offers),
    )


def _duration(offer: Mapping[str, Any], key: str) -> int:
    """Read a duration [ns], of which 0 means that there is none."""
    entry = offer.get(key) or {}
    return min(entry.get('sec', 0) * 10**9 + entry.get('nsec', 0), FOREVER) or FOREVER
