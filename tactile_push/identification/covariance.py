# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How well pushes tell fitted numbers: from how residuals scatter, and how they change with them.

References
----------
P. J. Huber, "Robust Statistics", Wiley, 1981, section 7.6.
R. M. Bell and D. F. McCaffrey, "Bias reduction in standard errors for linear regression with
multi-stage samples", Survey Methodology 28 (2), 169-181, 2002: the jackknife.
"""

import numpy as np

from tactile_push.mechanics.compiled import Array

ROBUST = 0.25  # residual from which on a loss is linear [width]
FINEST = 1e-7  # width that a measurement has at least [m]
MOST_HIDDEN = 0.5  # share of an error that a push hides by what it tells; more is not made up for
LEAST = 1.0  # information about a number of the size of 1 that is not open
MAD = 1.4826  # standard deviation of a normal distribution over its median absolute value


def widths(residual: Array, length: float) -> Array:
    """Return how wide residuals of poses and forces are, by their medians.

    Parameters
    ----------
    residual : ndarray, shape (N, 4)
        As `residuals` returns them.
    length : float
        Of the object, by which an angle is a length [m].

    Returns
    -------
    ndarray, shape (4,)
        Standard deviations, if they were normal [m, m, rad, rad]; positive.
    """
    poses = residual[:, :3] * [1.0, 1.0, length]
    force = residual[:, 3][np.isfinite(residual[:, 3])]
    position = max(MAD * float(np.median(np.abs(poses))), FINEST)
    direction = max(MAD * float(np.median(np.abs(force))), FINEST / length) if len(force) else 1.0
    return np.array([position, position, position / length, direction])


def robust_loss(squares: Array, data: int) -> Array:
    """Return the loss of squared residuals, as `scipy.optimize.least_squares` takes it.

    Parameters
    ----------
    squares : ndarray, shape (M,)
        Squares of residuals over their width, after those of the data those of the priors.
    data : int
        How many are of the data. The others count as they are.

    Returns
    -------
    ndarray, shape (3, M)
        Loss and its first and second derivative by the square.
    """
    loss = np.stack([squares, np.ones_like(squares), np.zeros_like(squares)])
    root = np.sqrt(1.0 + squares[:data] / ROBUST**2)
    loss[:, :data] = 2.0 * ROBUST**2 * (root - 1.0), 1.0 / root, -0.5 / ROBUST**2 / root**3
    return loss


def robust_covariance(scaled: Array, rates: Array, priors: Array) -> Array:
    """Compute the covariance of numbers with the least robust loss.

    Pushes are taken as independent. How the errors of one push hang together, and how they are
    distributed, the residuals tell. No variance is less than if all pushes had errors alike.

    Parameters
    ----------
    scaled : ndarray, shape (N, K)
        Residuals of each push over their width; NaN where there is none.
    rates : ndarray, shape (N, K, P)
        Their derivatives by the numbers.
    priors : ndarray, shape (P,)
        Standard deviations from 0 that the numbers have beforehand, or infinity.

    Returns
    -------
    ndarray, shape (P, P)
        The covariance. The variance of a number that the pushes leave open is infinite.
    """
    there = np.isfinite(scaled)
    value = np.where(there, scaled, 0.0)
    root = np.sqrt(1.0 + (value / ROBUST) ** 2)
    pull, stiffness = value / root, 1.0 / root**3
    count = np.maximum(there.sum(axis=0), 1)
    mean_stiffness = (stiffness * there).sum(axis=0) / count  # of each kind of residual
    rates = rates * there[:, :, np.newaxis]
    information = np.einsum('nki,k,nkj->ij', rates, mean_stiffness, rates)
    home = np.diag(1.0 / priors**2)
    told = np.diag(information + home) >= LEAST
    covariance = np.diag(np.where(told, 0.0, np.inf))
    some = np.ix_(told, told)
    information, home, rates = (information + home)[some], home[some], rates[:, :, told]
    if not told.any() or np.linalg.matrix_rank(information, hermitian=True) < told.sum():
        return np.diag(np.full(len(priors), np.inf))
    inverse = np.linalg.inv(information)
    # As if each push met numbers that are fitted to the others: its own pull hides its error.
    half = np.sqrt(mean_stiffness)
    seen = rates * half[:, np.newaxis]
    shares, axes = np.linalg.eigh(seen @ inverse @ seen.transpose(0, 2, 1))
    hidden = 1.0 / (1.0 - np.minimum(shares, MOST_HIDDEN))
    own = pull / np.where(half > 0.0, half, 1.0)
    own = np.einsum('nkl,nl,nml,nm->nk', axes, hidden, axes, own)
    pulls = np.einsum('nki,nk->ni', seen, own)
    found = inverse @ (pulls.T @ pulls + home) @ inverse
    # One push may be all that tells a number; then its error shows in those of the others alone.
    mean_square = (pull**2).sum(axis=0) / count
    alike = np.einsum('nki,k,nkj->ij', rates, mean_square, rates)
    least = np.diag(inverse @ (alike + home) @ inverse)
    wider = np.sqrt(np.maximum(least / np.diag(found), 1.0))
    covariance[some] = found * np.outer(wider, wider)
    return covariance


def deviations_with_noise_alone(rates: Array, slopes: Array) -> Array:
    """Compute the bound of Cramér and Rao on what is fitted without a prior.

    Parameters
    ----------
    rates : ndarray, shape (N, K, P)
        Derivatives of residuals over their width by the numbers.
    slopes : ndarray, shape (P, P)
        Derivatives of values by the numbers, each of which says one of them.

    Returns
    -------
    ndarray, shape (P,)
        Standard deviations of the values; infinite where the pushes leave one open.
    """
    flat = rates.reshape(-1, rates.shape[-1])
    told = (flat**2).sum(axis=0) >= LEAST
    found = np.full(len(slopes), np.inf)
    flat, slopes = flat[:, told], slopes[np.ix_(told, told)]
    if told.any() and np.linalg.matrix_rank(flat) == flat.shape[1]:
        found[told] = np.sqrt(np.diag(slopes @ np.linalg.inv(flat.T @ flat) @ slopes.T))
    return found
