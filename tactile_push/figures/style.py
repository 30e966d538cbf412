# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Sizes, fonts and colours of all figures, fit for a publication."""

import matplotlib.figure
import matplotlib.style
from matplotlib.backends.backend_agg import FigureCanvasAgg

ONE_COLUMN = 3.5  # width of a column of the journal [in]
TWO_COLUMNS = 7.16
CENTIMETRE = 100.0  # of a metre: figures show centimetres

# From the palette of Okabe and Ito: the colour-blind, and readers in grey, can tell them apart.
BLACK = '#000000'
BLUE = '#0072B2'
ORANGE = '#E69F00'
RED = '#D55E00'
GREY = '0.45'
PALE = '0.7'
PALE_BLUE = '#A9CCE0'

styled = matplotlib.style.context(
    [
        'default',
        {
            'font.family': 'sans-serif',
            'font.sans-serif': ['DejaVu Sans'],  # which comes with matplotlib
            'font.size': 8.0,
            'axes.labelsize': 8.0,
            'axes.titlesize': 8.0,
            'xtick.labelsize': 8.0,
            'ytick.labelsize': 8.0,
            'legend.fontsize': 8.0,
            'legend.frameon': False,
            'axes.linewidth': 0.6,
            'xtick.major.width': 0.6,
            'ytick.major.width': 0.6,
            'lines.linewidth': 1.2,
            'patch.linewidth': 0.8,
            'savefig.dpi': 300,
            'svg.fonttype': 'none',  # text stays text
            'svg.hashsalt': 'tactile_push',  # the same names of clip paths in every run
        },
    ]
)
"""Decorator that sets matplotlib's defaults with fonts and lines fit for a publication."""


def new_figure(width: float, height: float) -> matplotlib.figure.Figure:
    """Return an empty figure of a size [in], which needs no display."""
    figure = matplotlib.figure.Figure(figsize=(width, height), layout='constrained')
    FigureCanvasAgg(figure)
    return figure
