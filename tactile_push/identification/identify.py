# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From measured pushes to what an object rests on and how much friction it has."""

from dataclasses import dataclass, replace

import numpy as np

from tactile_push.identification.bad_records import most_of, named, untouched
from tactile_push.identification.fitting import Fit, Fitter
from tactile_push.identification.models import Model, known_support, nominal, unknown_support
from tactile_push.identification.predicting import Errors, errors_of, residuals
from tactile_push.identification.records import Bad, Pushes
from tactile_push.mechanics import Support
from tactile_push.mechanics.compiled import Array

FEWEST = 8  # pushes: as many poses in each half as leave twice the numbers that are fitted
MOST_BAD = 0.1  # share of the records that may be bad


@dataclass(frozen=True)
class Identified:
    """What pushes say of an object."""

    fit: Fit  #: to all pushes that are used
    pushes: Pushes  #: those that are used, and the records that are not
    #: of each push, predicted by numbers fitted to every second one that it is none of
    residual: Array
    nominal: Errors  #: of a prediction with nothing fitted but the support, if it is known

    @property
    def errors(self) -> Errors:
        """Errors of predictions by numbers that do not know the push."""
        return errors_of(self.residual)


def model_of(pushes: Pushes) -> Model:
    """Return the numbers that are fitted: those of the support as well, if it is not known.

    Parameters
    ----------
    pushes : Pushes
        The pushes.

    Returns
    -------
    Model
        The model.
    """
    if pushes.support is not None:
        return known_support(pushes.support)
    return unknown_support(pushes.outline)


def halves_of(pushes: Pushes) -> tuple[range, range]:
    """Return the indices of every second push, and of the others.

    Parameters
    ----------
    pushes : Pushes
        The pushes.

    Returns
    -------
    tuple of range
        Both halves.
    """
    return range(0, len(pushes.pushes), 2), range(1, len(pushes.pushes), 2)


def crosswise(pushes: Pushes, fits: tuple[Fit, Fit]) -> Array:
    """Predict each push by the numbers of the half that it is not in.

    Parameters
    ----------
    pushes : Pushes
        The pushes.
    fits : tuple of Fit
        To the halves of `halves_of`.

    Returns
    -------
    ndarray, shape (N, 4)
        As `residuals` returns them.
    """
    found = np.empty((len(pushes.pushes), 4))
    for other, fit in zip(reversed(halves_of(pushes)), fits, strict=True):
        found[other] = residuals(pushes.of(other), fit.physics)
    return found


def identify(pushes: Pushes) -> Identified:
    """Find support, friction and centre of friction of an object.

    Parameters
    ----------
    pushes : Pushes
        Measured pushes. If its support is known, friction alone is fitted.

    Returns
    -------
    Identified
        The numbers, how well the pushes tell them, and the records that were left out.

    Raises
    ------
    ValueError
        If too few pushes are left or too many records are bad.
    """
    total = len(pushes.pushes) + len(pushes.bad)
    pushes = _without(pushes, untouched(pushes), 'the object moves, but the tip never touches it')
    _check_enough(pushes, total)
    fitter = Fitter(model_of(pushes), pushes)
    fit = fitter.fit(range(len(pushes.pushes)))
    length = Support.uniform(pushes.outline, 1).c
    errors = errors_of(residuals(pushes, fit.physics, forces=False))
    sizes = np.hypot(errors.position, length * errors.angle)
    most = most_of(sizes)
    far = np.flatnonzero(sizes > most).tolist()
    if far:
        others = f'half of the others are within {1e3 * float(np.median(sizes)):.2g} mm'
        reason = f'its end is more than {1e3 * most:.2g} mm from the predicted one, {others}'
        pushes = _without(pushes, far, reason)
        _check_enough(pushes, total)
        fitter = Fitter(model_of(pushes), pushes)
        fit = fitter.fit(range(len(pushes.pushes)))
    first, second = (fitter.fit(half) for half in halves_of(pushes))
    start = nominal(pushes.outline)
    if pushes.support is not None:
        start = replace(start, support=pushes.support)
    return Identified(
        fit, pushes, crosswise(pushes, (first, second)), errors_of(residuals(pushes, start))
    )


def _without(pushes: Pushes, found: list[int], reason: str) -> Pushes:
    kept = pushes.of([k for k in range(len(pushes.pushes)) if k not in found])
    return replace(kept, bad=(*pushes.bad, *named(pushes, found, reason)))


def _check_enough(pushes: Pushes, total: int) -> None:
    """Refuse data of which too little can be used, and say what is wrong with the first record."""
    bad, left = pushes.bad, len(pushes.pushes)
    why = f'; {_words(bad[0])}' if bad else ''
    if len(bad) > MOST_BAD * total:
        most = f'{MOST_BAD:.0%} bad records'
        raise ValueError(f'pushes: expected at most {most}, got {len(bad)} of {total}{why}')
    if left < FEWEST:
        raise ValueError(f'pushes: expected {FEWEST} or more, got {left}{why}')


def _words(bad: Bad) -> str:
    return f'{bad.name}: {bad.reason}'
