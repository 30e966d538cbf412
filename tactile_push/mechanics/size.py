# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Whether an object can be as large as somebody says, or the lengths are millimetres."""

from tactile_push.mechanics.outline import Outline

LONGEST = 10.0  # outline that is believed [m]; picked, several times what a finger can reach around


def check_metres(name: str, outline: Outline) -> None:
    """Refuse an outline that is far too long for an object, as one given in millimetres is.

    Parameters
    ----------
    name : str
        What to blame.
    outline : Outline
        The outline, lengths in metres if all is well.

    Raises
    ------
    ValueError
        If it is longer than `LONGEST`.
    """
    if outline.length > LONGEST:
        raise ValueError(
            f'{name}: expected metres, got an object {outline.length:.3g} m around; '
            'are these millimetres?'
        )
