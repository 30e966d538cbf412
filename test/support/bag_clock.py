# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The time of a bag of some day, for the tests of what is replayed."""

from tactile_push.pipeline.stamps import epoch_of, seconds_since

BEGIN = 1_795_000_000  # some day in 2026 [s]
EPOCH = epoch_of(BEGIN)
PERIOD = 100_000_000  # [ns]


def stamp_of(nanoseconds):
    return divmod(nanoseconds, 10**9)


def seconds(nanoseconds):
    return seconds_since(EPOCH, *stamp_of(nanoseconds))
