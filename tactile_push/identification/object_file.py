# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What was identified, as the object file of `tactile_push simulate` and for nodes."""

import math
from typing import Any

from tactile_push.identification.identify import Identified
from tactile_push.paper import DISK
from tactile_push.parameters.mujoco_plant import SPREAD
from tactile_push.parameters.sim_plant import POLYGON

SURE = 3.0  # standard deviations within which a number is taken to be
MODEL = 0.1  # share of a number by which the model may be wrong about it; as halves of data differ


def object_content(outline: dict[str, Any], found: Identified) -> dict[str, Any]:
    """Return the content of an object file.

    Parameters
    ----------
    outline : dict
        The outline, as a file has it.
    found : Identified
        What pushes say of the object.

    Returns
    -------
    dict
        Outline, centre of mass, support and mu_c as `simulation.read_object` takes them, and the
        standard deviations of what was fitted. mu_c is left out if no push slips and tells it. The
        centre of mass is where the loads balance, under an even mu_s.
    """
    physics = found.fit.physics
    support = physics.support
    rests: dict[str, Any]
    if math.isnan(physics.spread):
        loads = (support.loads / support.f_max).tolist()
        rests = {'support': {'points': support.points.tolist(), 'loads': loads}}
    else:
        rests = {'centre_of_mass': list(support.centre), 'support': {'spread': physics.spread}}
    told = {name: of for name, of in found.fit.deviations.items() if math.isfinite(of)}
    friction = {'mu_c': physics.mu_c} if 'mu_c' in told else {}
    return {'outline': outline, **rests, **friction, 'standard_deviations': told}


def sensing_values(found: Identified) -> dict[str, object]:
    """Return the parameters by which `active_sensing` knows the object.

    Parameters
    ----------
    found : Identified
        What pushes say of the object.

    Returns
    -------
    dict
        The outline about the centre of friction, and ranges of c and mu_c as far as they are told.

    Raises
    ------
    ValueError
        If the outline is neither a polygon nor a circle.
    """
    physics, values = found.fit.physics, _outline(found)
    sure = {name: SURE * of for name, of in found.fit.deviations.items() if math.isfinite(of)}
    sure.setdefault('c', 0.0)  # of a known support
    for name, value in (('c', physics.support.c), ('mu_c', physics.mu_c)):
        if name in sure:
            by = max(sure[name], MODEL * value)
            values[f'{name}_min'], values[f'{name}_max'] = max(value - by, 0.0), value + by
    return values


def plant_values(found: Identified) -> dict[str, object]:
    """Return the parameters by which `sim_plant` simulates the object, on an ellipsoid.

    Parameters
    ----------
    found : Identified
        What pushes say of the object.

    Returns
    -------
    dict
        Outline, c, mu_c if it is told, and a start on the first edge.

    Raises
    ------
    ValueError
        If the outline is neither a polygon nor a circle.
    """
    return {**_pushed(found), 'c': found.fit.physics.support.c}


def mujoco_plant_values(found: Identified) -> dict[str, object]:
    """Return the parameters by which `mujoco_plant` simulates the object, on feet.

    Parameters
    ----------
    found : Identified
        What pushes say of the object, whose load is spread.

    Returns
    -------
    dict
        As `plant_values`, but how far the load is spread takes the place of c.

    Raises
    ------
    ValueError
        If the outline is neither a polygon nor a circle.
    """
    return {**_pushed(found), 'support': SPREAD, 'spread': found.fit.physics.spread}


def _pushed(found: Identified) -> dict[str, object]:
    """Return outline, mu_c if it is told, and a start on the first edge, for both plants."""
    physics, values = found.fit.physics, _outline(found)
    start: dict[str, object] = {'object': DISK}
    if 'vertices' in values:
        x, y, tau, length, _ = found.pushes.outline.about(*physics.support.centre).pieces[0]
        first = x * math.cos(tau) + y * math.sin(tau)  # d of its first corner
        start = {'object': POLYGON, 'd_initial': float(min(max(first, 0.0), first + length))}
    friction = {} if 'mu_c' in found.fit.open else {'mu_c': physics.mu_c}
    return {**start, **values, **friction}


def _outline(found: Identified) -> dict[str, object]:
    """Return the outline about the centre of friction as nodes know it."""
    outline = found.pushes.outline
    if len(outline.pieces) == 1:
        return {'disk_radius': outline.length / math.tau}
    if not ((outline.pieces[:, 3] == 0.0) | (outline.pieces[:, 4] == 0.0)).all():
        raise ValueError('outline: expected a polygon or a circle for the nodes, got arcs')
    corners = outline.points(outline.length) - found.fit.physics.support.centre
    return {'vertices': corners.ravel().tolist()}
