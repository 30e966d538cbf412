# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Where a contact is of which the tip's rim, or the image's, hides a part.

The centroid of what is left lies too far from the rim. But a contact on a sphere is round: its
outline lies in a plane, whose normal leads to the contact's middle, and the part of the outline
that is left tells the plane. The circle is then seen whole by the camera's model, which is also
good below the rim.
"""

import math

import cv2
import numpy as np
import numpy.typing as npt

from tactile_push.tactile.dome_camera import DomeCamera
from tactile_push.tactile.sphere import Array
from tactile_push.tactile.touched_region import MEDIAN, SMOOTHING, Image, Region

SPOILED = MEDIAN // 2 + SMOOTHING // 2  # the filters mix what is nearer to the rim with it [px]
LEAST_OUTLINE = 12  # pixels of an outline that tell a plane; picked
CORNERS = 36  # of the circle's image
# The pressure under a round contact is distributed by Hertz. The centroid of the change is then
# that of a uniform disk whose radius is smaller by this factor: their second moments, 2/5 and 1/2
# of the square of the radius, agree.
UNIFORM = math.sqrt(0.8)


class CutRegions:
    """Completes regions that the rim cuts.

    Parameters
    ----------
    camera : DomeCamera
        The camera.
    """

    def __init__(self, camera: DomeCamera) -> None:
        self.dome = camera.dome().view(np.uint8)  #: nonzero on the dome, shape (height, width)
        self._camera = camera
        self._inner, self._clear = _without_rim(self.dome, 1), _without_rim(self.dome, SPOILED)

    def completed(self, region: Region) -> Region:
        """Return a region as it would be if the tip went on beyond its rim.

        Parameters
        ----------
        region : Region
            A region of the dome.

        Returns
        -------
        Region
            With another centroid, and the area that is seen; the same one if no rim cuts it, or if
            too little of its outline is left to tell.
        """
        columns, rows = region.outline.T
        clear = self._clear[rows, columns] > 0
        if self._inner[rows, columns].all() or np.count_nonzero(clear) < LEAST_OUTLINE:
            return region
        outline = self._camera.directions(region.outline[clear])
        normal, *_ = np.linalg.lstsq(outline, np.ones(len(outline)), rcond=None)
        size = math.hypot(*normal)  # one over the plane's distance from the centre
        if not size > 1.0:
            return region
        image = self._image(np.asarray(normal / size, float), UNIFORM * math.acos(1.0 / size))
        moments = cv2.moments(image)
        if moments['m00'] == 0.0:
            return region
        x, y = (moments[name] / moments['m00'] for name in ('m10', 'm01'))
        return region._replace(x=x, y=y)

    def _image(self, middle: Array, radius: float) -> npt.NDArray[np.float32]:
        """Return the image of a circle on the sphere, shape (n, 2) [px]."""
        _, _, across = np.linalg.svd(middle[None])
        turn = np.linspace(0.0, 2.0 * math.pi, CORNERS, endpoint=False)
        around = np.stack([np.cos(turn), np.sin(turn)], axis=-1) @ across[1:]
        circle = math.cos(radius) * middle + math.sin(radius) * around
        return self._camera.pixels(circle).astype(np.float32)


def _without_rim(dome: Image, width: int) -> Image:
    """Return the dome without pixels so near to its rim or to the image's edge."""
    near = np.ones((2 * width + 1, 2 * width + 1), np.uint8)
    return cv2.erode(dome, near, borderType=cv2.BORDER_CONSTANT, borderValue=0)
