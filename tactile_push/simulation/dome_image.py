# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Images of a hemispherical tip as a camera inside it takes them, spoiled as real ones are.

A ray leaves the camera through a lens of closed form, meets the dome's skin, which a ring of lamps
lights unevenly, and lands on a sensor out of focus, with vignetting, noise and dead pixels. A
contact changes the skin's brightness as the pressure under a sphere is distributed by Hertz. Only
OpenCV's filter is shared with the finder of contacts, and none of its equations.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import cv2
import numpy as np
import numpy.typing as npt

from tactile_push.tactile.reading import Reading

Pixels = npt.NDArray[np.float32]
Image = npt.NDArray[np.uint8]

#: angle off the axis [rad] at a distance from the axis' image, in focal lengths
LENSES: dict[str, Callable[[Pixels], Pixels]] = {
    'equisolid': lambda radius: 2.0 * np.arcsin(np.minimum(radius / 2.0, 1.0)),
    'pinhole': np.arctan,
}
HOUSING = 6.0  # brightness of what is no dome [levels]
WHITE = 255.0  # brightest level


@dataclass(frozen=True)
class DomeView:
    """A camera in a tip, the tip's skin, and what spoils the image."""

    width: int = 640  #: [px]
    height: int = 480  #: [px]
    lens: str = 'equisolid'  #: one of `LENSES`
    focal_length: float = 290.0  #: [px]
    principal_point: tuple[float, float] = (0.0, 0.0)  #: of the lens from the image's middle [px]
    eye: tuple[float, float, float] = (0.0, 0.0, -1.0)  #: from the dome's centre [radii]
    #: how the camera is turned from upright [rad], about the pole, then about its right, then about
    #: its lower edge
    turned: tuple[float, float, float] = (0.0, 0.0, 0.0)
    skin: float = 90.0  #: brightness of the lit skin, 0 for a waveguide [levels]
    touch: float = (
        80.0  #: by how much a contact changes it at most; negative if it darkens [levels]
    )
    stiffness: float = 250.0  #: force of a contact as wide as the dome's radius [N]
    defocus: float = 3.0  #: radius of the disk that a point becomes [px]
    vignetting: float = 0.4  #: loss of light in the image's corners, 0 to 1
    noise: float = 0.02  #: standard deviation of a pixel, in parts of the brightest level
    dead: float = 0.0  #: share of the pixels that are always black or always white


class DomeImages:
    """Renders the images of one camera; the same seed gives the same images."""

    def __init__(self, view: DomeView, seed: int = 0) -> None:
        self.view = view
        self._random = np.random.default_rng(seed)
        rows, columns = np.mgrid[: view.height, : view.width].astype(np.float32)
        middle = (view.width - 1) / 2.0, (view.height - 1) / 2.0
        x = (columns - middle[0] - view.principal_point[0]) / view.focal_length
        y = (rows - middle[1] - view.principal_point[1]) / view.focal_length
        radius = np.hypot(x, y)
        alpha = LENSES[view.lens](radius)
        # Upright, the camera's right is the tip's -x and its lower edge the tip's -y.
        ray = np.stack([-np.sin(alpha) * x, -np.sin(alpha) * y, np.cos(alpha)], axis=-1)
        ray[..., :2] /= np.maximum(radius, 1e-9)[..., None]
        self._skin = _meeting(_turned(ray, *view.turned), view.eye)
        self._on_dome = self._skin[..., 2] >= 0.0  # False for NaN
        self._lit = self._brightness()
        corner = math.hypot(*middle) / view.focal_length
        self._vignette = 1.0 - view.vignetting * np.minimum(radius / corner, 1.0) ** 2
        self._disk = _disk(view.defocus)
        dead = self._random.random(radius.shape) < view.dead
        self._black = dead & (self._random.random(radius.shape) < 0.5)
        self._white = dead & ~self._black

    def image(self, reading: Reading) -> Image:
        """Render the image of a contact.

        Parameters
        ----------
        reading : Reading
            Where the tip is touched, and the normal force [N]; no contact and no force are the
            same.

        Returns
        -------
        ndarray of uint8, shape (height, width)
            The image.
        """
        light = self._lit
        if reading.in_contact and reading.normal_force > 0.0:
            light = light + self.view.touch * self._pressure(reading)
        light = cv2.filter2D(light, -1, self._disk, borderType=cv2.BORDER_REPLICATE)
        light = light * self._vignette
        light += self._random.standard_normal(light.shape, np.float32) * (WHITE * self.view.noise)
        image = np.clip(np.rint(light), 0.0, WHITE).astype(np.uint8)
        image[self._black] = 0
        image[self._white] = 255
        return image

    def _brightness(self) -> Pixels:
        """Return how bright the untouched skin is, lit by lamps around its rim."""
        x, y, z = np.moveaxis(self._skin, -1, 0)
        uneven = 1.0 + 0.25 * x - 0.15 * y + 0.2 * x * y - 0.1 * x * (x * x - 3.0 * y * y)
        lit = self.view.skin * (0.7 + 0.3 * z) * uneven
        return np.where(self._on_dome, lit, HOUSING).astype(np.float32)

    def _pressure(self, reading: Reading) -> Pixels:
        """Return the pressure on the skin over its maximum."""
        a, e = reading.azimuth, reading.elevation
        at = [math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e)]
        along = self._skin @ np.array(at, np.float32)
        reach = min((reading.normal_force / self.view.stiffness) ** (1.0 / 3.0), 1.0)
        inside = self._on_dome & (along > 0.0)
        square = np.where(inside, 1.0 - (1.0 - along * along) / reach**2, 0.0)
        return np.sqrt(np.maximum(square, 0.0)).astype(np.float32)


def pressed(reading: Reading, force: tuple[float, float]) -> Reading:
    """Return a reading of a skin that a force [N] dents, whatever its direction."""
    return replace(reading, normal_force=math.hypot(*force))


def _turned(ray: Pixels, roll: float, pitch: float, yaw: float) -> Pixels:
    """Return rays of a camera that is turned about the pole and then about its own right and up."""
    c, s = math.cos(roll), math.sin(roll)
    about_pole = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    c, s = math.cos(pitch), math.sin(pitch)
    about_right = np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
    c, s = math.cos(yaw), math.sin(yaw)
    about_down = np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])
    return ray @ (about_pole @ about_right @ about_down).T.astype(np.float32)


def _meeting(ray: Pixels, eye: tuple[float, float, float]) -> Pixels:
    """Return where rays from the eye leave the unit sphere, NaN if they miss it."""
    from_eye = np.array(eye, np.float32)
    nearest = ray @ from_eye
    with np.errstate(invalid='ignore'):
        way = np.sqrt(nearest**2 - (from_eye @ from_eye - 1.0)) - nearest
    return from_eye + np.where(way > 0.0, way, np.nan).astype(np.float32)[..., None] * ray


def _disk(radius: float) -> Pixels:
    """Return the image of a point out of focus: a disk with a soft rim, of sum 1."""
    half = math.ceil(radius + 0.5)
    y, x = np.mgrid[-half : half + 1, -half : half + 1]
    disk = np.clip(radius + 0.5 - np.hypot(x, y), 0.0, 1.0).astype(np.float32)
    return disk / disk.sum()
