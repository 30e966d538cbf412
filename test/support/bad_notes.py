# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Notes on parameters that are of another shape, each with the words that tell so."""

NO_JSON = 'the recorded parameters are left out: expected JSON, node to values'
BAD_NOTES = {
    'no JSON': ('{', NO_JSON),
    'nothing': ('', NO_JSON),
    'a list': ('[]', NO_JSON),
    'a number': ('3', NO_JSON),
    'null': ('null', NO_JSON),
    'deep': ('[' * 100_000, NO_JSON),
    'a number for values': (
        '{"push_controller": 3}',
        'recorded parameters of /push_controller: left out: expected values by name, got 3',
    ),
    'a list for values': (
        '{"push_controller": [["kp", 0.05]]}',
        "/push_controller: left out: expected values by name, got [['kp', 0.05]]",
    ),
    'a text for a number': (
        '{"push_controller": {"kp": "fast"}}',
        'recorded parameters of /push_controller: left out: parameter kp: expected a number',
    ),
    'a mapping for a list': (
        '{"active_sensing": {"vertices": {"x": 1}, "edge": 0}}',
        'recorded parameters of /active_sensing: left out: parameter vertices: expected a list',
    ),
    'a list for a text': (
        '{"sim_plant": {"object": ["block"]}, "contact_geometry": {}}',
        'recorded parameters of /sim_plant: left out: parameter object: expected one of',
    ),
    'a long text': ('{"push_controller": "%s"}' % ('long' * 10_000), "got 'longlong"),
    'no text': ('{"push_controller": {"kp": "\\ud800"}}', 'parameter kp: expected'),
    'no text as a node': ('{"\\ud800": 3}', 'left out: expected values by name, got 3'),
}
