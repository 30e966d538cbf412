# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Laws with goals, as the parameters of `push_controller` have them. They load the compiler."""

import math
from collections.abc import Callable
from typing import Any

from tactile_push.control import PushControl
from tactile_push.control.placing.believing import BelievingLaw
from tactile_push.control.placing.compiling import (
    compile_placing,
    compile_settling,
    compile_steering,
)
from tactile_push.control.placing.law import NOWHERE, PlaceLaw
from tactile_push.control.placing.regrasp import Moves
from tactile_push.control.placing.settle_law import SettleLaw
from tactile_push.control.placing.steer_law import SteerLaw
from tactile_push.interface import PLACE, SETTLE, STEER
from tactile_push.parameters.push_controller import PushControllerParameters
from tactile_push.pipeline import Seconds
from tactile_push.pipeline.believing import Believing
from tactile_push.pipeline.lasting import Lasting
from tactile_push.pipeline.placing import Placing
from tactile_push.pipeline.settling import Settling
from tactile_push.pipeline.steering import Carrying

# Laws that do what law (18) does without estimates, what compiles them, and who serves their goals.
LASTING: dict[str, tuple[type[BelievingLaw], Callable[[], None], type[Lasting]]] = {
    STEER: (SteerLaw, compile_steering, Carrying),
    SETTLE: (SettleLaw, compile_settling, Settling),
}


def give_law(push: PushControl, p: PushControllerParameters, seconds: Seconds) -> Believing:
    """Give a control the law with goals that the parameters name, compiled.

    Parameters
    ----------
    push, p, seconds : PushControl, PushControllerParameters, callable
        The control, the parameters, and what returns the time [s] of a stamp.

    Returns
    -------
    Believing
        What serves the law's goals.
    """
    if p.law == PLACE:
        compile_placing()
        return Placing(push, _place_law(p), seconds)
    law_class, compile_law, serving = LASTING[p.law]
    law = law_class(p.theta_desired, p.belt_speed, 1.0 / p.control_rate, **_bounds(p))
    law.tune(p.kp, p.kd, p.theta_desired)
    compile_law()
    return serving(push, law, seconds)


def _place_law(p: PushControllerParameters) -> PlaceLaw:
    """Return the law that places, without a goal."""
    return PlaceLaw(
        *(NOWHERE, p.belt_length, p.belt_speed, 1.0 / p.control_rate),
        delay=p.release_delay,
        moves=Moves(p.max_speed, p.max_acceleration, p.belt_speed) if p.axes == 2 else None,
        room=p.retreat_max,
        **_bounds(p),
    )


def _bounds(p: PushControllerParameters) -> dict[str, Any]:
    """Return what bounds the commands of a law that believes."""
    slowest = math.atan2(p.belt_speed, p.max_speed)  # phi at the greatest speed
    return {
        'lag': p.finger_lag,
        'workspace': (p.workspace_min, p.workspace_max),
        'rate': p.max_acceleration,
        'felt': p.detectable_range,
        'phi_min': max(p.phi_min, slowest),
        'phi_max': min(p.phi_max, math.pi - slowest),
    }
