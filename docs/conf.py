# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Sphinx's settings, for `make docs` and for rosdoc2 alike. The build needs no network."""

import os
import re

# With compilation off, numba's decorators return the functions with their docstrings.
os.environ['NUMBA_DISABLE_JIT'] = '1'

project = 'tactile_push'
author = 'The tactile_push authors'
copyright = f'2026 {author}'

extensions = ['myst_parser', 'sphinx.ext.autodoc', 'sphinx.ext.napoleon', 'sphinx_rtd_theme']
exclude_patterns = ['__*', 'README.md', 'CONTRIBUTING.md', 'CHANGELOG.rst']  # rosdoc2 adds these
suppress_warnings = ['config.cache']

html_theme = 'sphinx_rtd_theme'
html_theme_options = {'navigation_depth': 3}
html_static_path = ['_static']
html_css_files = ['site.css']
html_show_sphinx = False
html_copy_source = False

myst_heading_anchors = 3

# The docstrings name the types of the arguments, with shapes and units.
autodoc_typehints = 'none'
autodoc_member_order = 'bysource'
napoleon_google_docstring = False
napoleon_use_ivar = True
napoleon_use_rtype = False
default_role = 'code'


def _escape_bars(app, what, name, obj, options, lines):
    """Keep the bars of an absolute value, as in |theta|, which are a substitution in reST."""
    lines[:] = [re.sub(r'(`[^`]*`)|\|', lambda bar: bar[1] or r'\|', line) for line in lines]


def setup(app):
    """Connect the handler."""
    app.connect('autodoc-process-docstring', _escape_bars)
