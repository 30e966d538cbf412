# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Friction at the contact (Section I.A) and the voting theorem (Section II.A)."""

import math

from tactile_push.mechanics.compiled import compiled


def check_friction(mu_c: float) -> None:
    """Refuse a coefficient of friction that is negative or not a number.

    Parameters
    ----------
    mu_c : float
        Coefficient of friction between finger and object, 0 to infinity.

    Raises
    ------
    ValueError
        If `mu_c` is negative or NaN.
    """
    if not mu_c >= 0.0:
        raise ValueError(f'mu_c: expected a coefficient of friction of 0 or more, got {mu_c}')


@compiled
def friction_cone(mu_c: float) -> tuple[float, float]:
    """Give the half angle of the friction cone, alpha = atan(mu_c), by its cosine and sine.

    The cone's edges in the edge frame (tangent, normal) are (-sin alpha, cos alpha) on the left
    and (sin alpha, cos alpha) on the right. Without friction both are the normal; with infinite
    friction they are exactly the two tangent directions.

    Parameters
    ----------
    mu_c : float
        Coefficient of friction between finger and object, 0 to infinity.

    Returns
    -------
    cos_alpha, sin_alpha : float
        Direction cosines of the cone's edge.
    """
    if math.isinf(mu_c):
        return 0.0, 1.0
    cos_alpha = 1.0 / math.hypot(1.0, mu_c)
    return cos_alpha, mu_c * cos_alpha


def translation_contacts(mu_c: float, l: float) -> tuple[float, float]:
    """Give the contacts from which the edge can be translated: -mu_c l <= d <= mu_c l.

    Parameters
    ----------
    mu_c : float
        Coefficient of friction between finger and object, 0 to infinity.
    l : float
        Distance from the pushed edge to the centre of mass [m], positive.

    Returns
    -------
    lower, upper : float
        Bounds of d [m]. A finite edge cuts them off at its ends.

    Raises
    ------
    ValueError
        If `mu_c` is negative or NaN, or `l` is not positive.
    """
    check_friction(mu_c)
    if not l > 0.0:
        raise ValueError(f'l: expected a positive distance [m], got {l}')
    return -mu_c * l, mu_c * l


def voted_rotation(d: float, l: float, beta: float, mu_c: float) -> int:
    """Tell the sense of rotation of a pushed object by Mason's voting theorem (II.A).

    Three rays leave the contact: the two edges of the friction cone and the direction of the
    finger's motion. A ray that passes to the left of the centre of mass votes for clockwise
    rotation, one that passes to the right for counterclockwise; the majority decides. If two rays
    pass through the centre of mass, or one does and the others disagree, the object translates.

    Parameters
    ----------
    d : float
        Contact along the edge [m].
    l : float
        Distance from the edge to the centre of mass [m], positive.
    beta : float
        Push direction relative to the edge, phi - theta [rad], in (0, pi).
    mu_c : float
        Coefficient of friction between finger and object, 0 to infinity.

    Returns
    -------
    int
        1 counterclockwise, -1 clockwise, 0 translation.
    """
    cos_alpha, sin_alpha = friction_cone(mu_c)
    # In the edge frame the centre of mass lies at (-d, l) from the contact.
    rays = (
        (-sin_alpha, cos_alpha),
        (sin_alpha, cos_alpha),
        (math.cos(beta), math.sin(beta)),
    )
    moments = [d * ray_n + l * ray_t for ray_t, ray_n in rays]
    # The majority of three, where a ray through the centre of mass abstains: the middle one.
    return sorted((moment > 0.0) - (moment < 0.0) for moment in moments)[1]
