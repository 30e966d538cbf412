# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The page, made of the report's parts and of watch.html, watch.css and the scripts in assets/."""

import html
from string import Template

from tactile_push.report.page_parts import allowance, asset, own_script

OF_REPORT = ('panels.js', 'view.js')
OWN = ('watch.js', 'strips.js')


def live_page(namespace: str) -> tuple[str, dict[str, str]]:
    """Return the page of a finger's namespace, '/' or such as '/left', and its HTTP headers."""
    script = own_script(
        *(asset(name, __package__) for name in OWN), *(asset(name) for name in OF_REPORT)
    )
    style = asset('page.css') + asset('watch.css', __package__)
    page = Template(asset('watch.html', __package__)).substitute(
        name=html.escape(namespace.strip('/') or 'finger'),
        style=style,
        view=asset('view.svg'),
        script=script,
    )
    policy = (
        "default-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'; "
        f"connect-src 'self'; img-src data:; style-src {allowance(style)}; "
        f'script-src {allowance(script)}'
    )
    return page, {
        'Content-Security-Policy': policy,
        'X-Content-Type-Options': 'nosniff',
        'Referrer-Policy': 'no-referrer',
        'Cache-Control': 'no-store',
    }
