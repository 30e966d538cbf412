# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m tactile_push.cli`."""

import sys

from tactile_push.cli import main

sys.exit(main())
