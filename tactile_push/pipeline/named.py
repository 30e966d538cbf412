# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a JointState message says whose names and positions may not fit together."""

from collections import Counter
from collections.abc import Sequence


def by_name(names: Sequence[str], positions: Sequence[float]) -> dict[str, float]:
    """Return the positions of a JointState message by name.

    A name has a value if it stands exactly once in the message and has a position. Nobody knows
    which value of a repeated name is meant, so such a name is missing, and whoever needs it does
    without the message: the finger stops on its timeouts rather than act on a guess. Names without
    a position and positions without a name are ignored.

    Parameters
    ----------
    names, positions : sequence of str, sequence of float
        Names and their positions.

    Returns
    -------
    dict of str to float
        Values by name.
    """
    values = dict(zip(names, positions, strict=False))
    if len(values) < len(names):
        times = Counter(names)
        values = {name: value for name, value in values.items() if times[name] == 1}
    return values
