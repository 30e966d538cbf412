# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What pages are made of."""

from tactile_push.report.page_parts import allowance, asset, own_script


def test_assets_are_those_of_the_room_that_is_asked():
    assert 'drawFrame' in asset('view.js')
    assert 'WebSocket' in asset('watch.js', 'tactile_push.watching')


def test_a_script_of_parts_is_one_function():
    assert own_script('a();', 'b();') == '(() => {\na();\nb();})();\n'


def test_allowance_is_the_digest_of_the_text_in_utf8():
    # echo -n 'é' | openssl dgst -sha256 -binary | base64
    assert allowance('é') == "'sha256-SplVfkAzw1Od4utlRyAXytX5VX96BiWgnxw/biumnEw='"
