# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Tests against the simulated plant: a pytest plugin, and the classes behind its fixtures.

The plugin `tactile_push.testing.plugin` has the fixtures `tactile_nodes`, `tactile_observer` and
`tactile_rig`. pytest loads it wherever this package is installed.
"""

import importlib
import typing

if typing.TYPE_CHECKING:
    from tactile_push.testing.observer import Observer, field, seconds
    from tactile_push.testing.processes import NodeProcesses
    from tactile_push.testing.rig import Rig

__all__ = ['NodeProcesses', 'Observer', 'Rig', 'field', 'seconds']
_MODULES = {'NodeProcesses': 'processes', 'Rig': 'rig'}


def __getattr__(name: str) -> typing.Any:
    """Import a public name when it is asked for: pytest loads the plugin for every test."""
    if name not in __all__:
        raise AttributeError(f'module {__name__!r} has no attribute {name!r}')
    module = importlib.import_module(f'{__name__}.{_MODULES.get(name, "observer")}')
    globals()[name] = getattr(module, name)
    return globals()[name]
