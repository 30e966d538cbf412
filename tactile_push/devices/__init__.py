# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The sensor as a device: its bytes, its sentences, and the thread that reads them."""

from tactile_push.devices.sentence import Sentence, SentenceError, checksum, decode, encode
from tactile_push.devices.stream import SentenceStream

__all__ = ['Sentence', 'SentenceError', 'SentenceStream', 'checksum', 'decode', 'encode']
