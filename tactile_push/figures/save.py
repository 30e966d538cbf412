# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The paper's figures as files."""

from collections.abc import Callable
from pathlib import Path

from tactile_push.figures.gains import gain_figure
from tactile_push.figures.limit_surfaces import limit_surface_figure, section_figure
from tactile_push.figures.motion_cones import motion_cone_figure
from tactile_push.figures.settling import settling_figure
from tactile_push.figures.simulations import step_response_figure, trajectory_figure
from tactile_push.figures.slow_mode import slow_mode_figure
from tactile_push.figures.style import styled

FIGURES = {
    'figure_2': limit_surface_figure,
    'figure_3': motion_cone_figure,
    'figure_6': section_figure,
    'figure_7': trajectory_figure,
    'figure_8': step_response_figure,
    'gains': gain_figure,
    'slow_mode': slow_mode_figure,
    'settling': settling_figure,
}


@styled
def save_figures(folder: Path, progress: Callable[[str], None] | None = None) -> list[Path]:
    """Make figures 2, 3, 6, 7 and 8 of the paper, and three of our own, as PNG and SVG.

    The same figures make the same files, to the byte for one version of matplotlib.

    Parameters
    ----------
    folder : Path
        Where to write figure_2.png, figure_2.svg, ..., settling.svg; made if it is not there. What
        is there under these names is replaced.
    progress : callable, optional
        Told the name of each file when it is written.

    Returns
    -------
    list of Path
        The files, in the order of the figures.

    Raises
    ------
    OSError
        If the folder cannot be written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    files = []
    for name, draw in FIGURES.items():
        figure = draw()
        for ending, metadata in (('png', None), ('svg', {'Date': None})):
            file = folder / f'{name}.{ending}'
            figure.savefig(file, metadata=metadata)
            files.append(file)
            if progress is not None:
                progress(file.name)
    return files
