# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a report shows, live: what the nodes say, on a page that a browser on the network reads."""
