# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Images of touches on the small tip of `support.dome`, in a folder with its table."""

import math

import cv2

from support.dome import DomePainter
from tactile_push.calibration.coverage import suggested_touches

SIZE = 5.0  # of a touch [px]: none reaches over the rim


def write_folder(folder, touches=None, untouched=3, noise=3.0):
    """Write images of touches at such places and `touches.csv`, and return the folder."""
    folder.mkdir(exist_ok=True)
    painter = DomePainter(noise=noise)
    lines = ['file,azimuth_deg,elevation_deg,normal_force']
    for number in range(untouched):
        cv2.imwrite(str(folder / f'free_{number}.png'), painter.image())
        lines.append(f'free_{number}.png,,,')
    for number, (azimuth, elevation) in enumerate(touches or suggested_touches()):
        image = painter.image(azimuth, elevation, size=SIZE)
        cv2.imwrite(str(folder / f'touch_{number}.png'), image)
        degrees = f'{math.degrees(azimuth):.4f},{math.degrees(elevation):.4f}'
        lines.append(f'touch_{number}.png,{degrees},1.5')
    (folder / 'touches.csv').write_text('\n'.join([*lines, '']))
    return folder
