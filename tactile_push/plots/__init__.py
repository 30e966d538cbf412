# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""Figures, and the page that reports a run."""

from tactile_push.plots.figures import save_figures
from tactile_push.plots.gains import gain_figure
from tactile_push.plots.history import plot_history
from tactile_push.plots.limit_surfaces import limit_surface_figure, section_figure
from tactile_push.plots.motion_cones import motion_cone_figure
from tactile_push.plots.report import report_html
from tactile_push.plots.report_data import Episode, Run, Scene, Series
from tactile_push.plots.simulations import step_response_figure, trajectory_figure

__all__ = [
    'Episode',
    'Run',
    'Scene',
    'Series',
    'gain_figure',
    'limit_surface_figure',
    'motion_cone_figure',
    'plot_history',
    'report_html',
    'save_figures',
    'section_figure',
    'step_response_figure',
    'trajectory_figure',
]
