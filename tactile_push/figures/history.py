# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Time histories as in figures 9 and 10 of the paper."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt

from tactile_push.figures.style import new_figure


def plot_history(
    panels: Mapping[str, tuple[npt.ArrayLike, npt.ArrayLike, float, float, int | None]],
    files: Sequence[Path],
) -> None:
    """Plot theta and phi - 90 degrees against the step, as in figures 9 and 10.

    The thin line is theta, the thick one phi - 90 degrees, as in the paper; the band about
    theta_d is the one within which theta counts as settled.

    Parameters
    ----------
    panels : mapping of str to tuple
        For each panel's title theta and phi [rad], shape (K + 1,) each, theta_d and the band's
        half width [rad], and the step from which theta stays within the band, or None. Where
        theta_d is NaN there is no band, and the step is that of another settling.
    files : sequence of Path
        Where to write; the ending chooses the format.
    """
    figure = new_figure(4.8 * len(panels), 3.6)
    axes = figure.subplots(1, len(panels), sharey=True, squeeze=False)[0]
    for axis, (title, (theta, phi, theta_d, band, settled)) in zip(
        axes, panels.items(), strict=True
    ):
        step = np.arange(np.size(theta))
        desired = np.degrees(theta_d)
        if np.isfinite(desired):
            axis.axhspan(
                desired - np.degrees(band), desired + np.degrees(band), color='0.9', label='_band'
            )
            axis.axhline(desired, color='0.5', linewidth=0.8, linestyle=(0, (6, 3)))
        axis.plot(step, np.degrees(phi) - 90.0, color='C1', linewidth=2.4, label='φ − 90°')
        axis.plot(step, np.degrees(theta), color='C0', linewidth=1.0, label='θ')
        if settled is not None:
            axis.axvline(settled, color='0.5', linewidth=0.8)
            axis.annotate(
                f'settled: step {settled}',
                (settled, 0.97),
                xycoords=('data', 'axes fraction'),
                xytext=(4, 0),
                textcoords='offset points',
                va='top',
                fontsize='small',
            )
        axis.set_title(title)
        axis.set_xlabel('step k')
        axis.set_xlim(0, max(step[-1], 1))
    axes[0].set_ylabel('angle [°]')
    axes[-1].legend(loc='center right', frameon=False)
    for file in files:
        figure.savefig(file, dpi=160)
