# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The live page as text: one document that asks nobody else for anything."""

import base64
import hashlib
import re

from tactile_push.watching.page import live_page


def test_only_the_pages_own_script_and_style_are_allowed():
    page, headers = live_page('/')
    policy = dict(part.split(' ', 1) for part in headers['Content-Security-Policy'].split('; '))
    assert policy['default-src'] == policy['frame-ancestors'] == "'none'"
    assert policy['connect-src'] == "'self'"
    for tag in ('script', 'style'):
        (text,) = re.findall(f'<{tag}>(.*?)</{tag}>', page, re.DOTALL)
        digest = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
        assert policy[f'{tag}-src'] == f"'sha256-{digest}'"
    assert re.findall(r'(?:src|href|action)="(?!data:)', page) == []
    assert ' style="' not in page  # which the policy would not allow
    assert not re.search(r' on\w+="', page)


def test_name_is_that_of_the_namespace_and_stays_text():
    assert '<h1>left</h1>' in live_page('/left')[0]
    assert '<h1>finger</h1>' in live_page('/')[0]
    assert '<h1>&lt;b&gt;</h1>' in live_page('/<b>')[0]
