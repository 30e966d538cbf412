# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The paper's figures and ours."""

from tactile_push.figures.gains import gain_figure
from tactile_push.figures.history import plot_history
from tactile_push.figures.limit_surfaces import limit_surface_figure, section_figure
from tactile_push.figures.motion_cones import motion_cone_figure
from tactile_push.figures.placing import plot_placed
from tactile_push.figures.save import save_figures
from tactile_push.figures.settling import settling_figure
from tactile_push.figures.simulations import step_response_figure, trajectory_figure
from tactile_push.figures.slow_mode import slow_mode_figure

__all__ = [
    'gain_figure',
    'limit_surface_figure',
    'motion_cone_figure',
    'plot_history',
    'plot_placed',
    'save_figures',
    'section_figure',
    'settling_figure',
    'slow_mode_figure',
    'step_response_figure',
    'trajectory_figure',
]
