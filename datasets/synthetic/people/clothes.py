"""What people's skin, hair and clothes look like."""

from __future__ import annotations

import cv2
import numpy as np

from roomgraph.datasets.synthetic.rendering.mesh import Image
from roomgraph.datasets.synthetic.textures import patterns
from roomgraph.datasets.synthetic.textures.patterns import Colour

SKINS: tuple[Colour, ...] = (
    (238, 204, 184), (226, 184, 158), (214, 168, 138), (190, 142, 108), (160, 112, 82),
    (124, 82, 58), (92, 60, 44),
)  # fmt: skip
HAIRS: tuple[Colour, ...] = (
    (34, 28, 26), (62, 44, 34), (94, 66, 44), (136, 98, 60), (196, 160, 104), (150, 146, 142),
    (120, 58, 34),
)  # fmt: skip
TOPS: tuple[Colour, ...] = (
    (230, 230, 228), (44, 52, 78), (150, 46, 46), (70, 104, 150), (90, 116, 84), (60, 60, 64),
    (196, 170, 120), (120, 84, 130), (214, 150, 60), (150, 176, 190), (206, 150, 160),
)  # fmt: skip
BOTTOMS: tuple[Colour, ...] = (
    (52, 66, 98), (70, 88, 124), (48, 48, 52), (140, 122, 96), (92, 92, 96), (70, 62, 52),
)  # fmt: skip
SHOES: tuple[Colour, ...] = (
    (48, 44, 42), (92, 62, 44), (226, 226, 222), (70, 76, 90), (150, 50, 50),
)  # fmt: skip
PATTERNS = ("plain", "plain", "stripes", "bands", "plaid")


def folds(rng: np.random.Generator, image: Image, depth: float = 0.30) -> Image:
    """Lay the soft shadows of folds over cloth."""
    height, width = image.shape[:2]
    value = depth * patterns.noise(rng, height, width, (height / 3, width / 14))
    value += depth * 0.8 * patterns.noise(rng, height, width, (height / 11, width / 6))
    return np.asarray(cv2.convertScaleAbs(image * (1 + value)[..., None]), dtype=np.uint8)


def cloth(
    rng: np.random.Generator, kind: str, shape: tuple[int, int], colour: Colour, other: Colour
) -> Image:
    """Return cloth of a kind: plain, stripes (upright), bands, plaid or jeans."""
    height, width = shape
    image = patterns.cloth(rng, height, width, colour)
    second = np.array(other, dtype=np.float32)
    x = np.zeros((height, width), dtype=np.float32)
    step = 20
    if kind in ("stripes", "plaid"):
        x[:, np.arange(width) % step < step // 3] += 0.55
    if kind in ("bands", "plaid"):
        x[np.arange(height) % step < step * 2 // 5] += 0.55
    if kind == "jeans":
        # Worn paler along the middle of the leg.
        fade = np.cos(np.linspace(-3.1, 3.1, width, dtype=np.float32)) * 0.10 + 0.05
        return folds(rng, patterns.tint(colour, fade + 0.16 * patterns.grain(rng, height, width)))
    share = np.minimum(x, 0.85)[..., None]
    mixed = np.asarray(image * (1 - share) + second * share, dtype=np.uint8)
    return folds(rng, mixed)


def open_front(image: Image, shirt: Colour, tie: Colour | None, skin: Colour) -> Image:
    """Open a jacket over a shirt in the middle of an image that goes once round the body."""
    height, width = image.shape[:2]
    centre, reach = width // 2, width // 10
    image = image.copy()
    wedge = [(centre - reach, 0), (centre + reach, 0), (centre, int(0.62 * height))]
    cv2.fillPoly(image, [np.array(wedge)], shirt, cv2.LINE_AA)
    if tie is not None:
        shape = [(-4, 4), (4, 4), (6, 0.45 * height), (0, 0.55 * height), (-6, 0.45 * height)]
        points = np.add(shape, (centre, 0)).astype(np.int32)
        cv2.fillPoly(image, [points], tie, cv2.LINE_AA)
    dark = tuple(int(c * 0.55) for c in image[height // 2, width // 4])
    for sign in (-1, 1):
        edge = (centre + sign * reach, 0)
        cv2.line(image, edge, (centre, int(0.62 * height)), dark, 3, cv2.LINE_AA)
    cv2.line(image, (centre, int(0.62 * height)), (centre, height), dark, 2, cv2.LINE_AA)
    return neckline(image, skin, 0.05)


def buttoned(image: Image, light: bool) -> Image:
    """Draw a row of buttons down the front of a shirt."""
    height, width = image.shape[:2]
    image = image.copy()
    colour = (60, 60, 64) if light else (232, 232, 228)
    line = tuple(int(c * 0.72) for c in image.mean(axis=(0, 1)))
    cv2.line(image, (width // 2 + 5, 0), (width // 2 + 5, height), line, 1, cv2.LINE_AA)
    for y in np.linspace(0.12, 0.95, 7):
        cv2.circle(image, (width // 2, int(y * height)), 2, colour, -1, cv2.LINE_AA)
    return image


def neckline(image: Image, skin: Colour, depth: float) -> Image:
    """Draw the neck's opening at the top of the front."""
    height, width = image.shape[:2]
    image = image.copy()
    axes = int(0.13 * width), int(depth * height)
    rim = tuple(int(c * 0.7) for c in image.mean(axis=(0, 1)))
    cv2.ellipse(image, (width // 2, 0), axes, 0, 0, 180, skin, -1, cv2.LINE_AA)
    cv2.ellipse(image, (width // 2, 0), axes, 0, 0, 180, rim, 2, cv2.LINE_AA)
    return image


def limb(rng: np.random.Generator, cloth_image: Image, skin: Colour, share: float) -> Image:
    """Return an image whose upper `share` is cloth and the rest bare skin."""
    height, width = cloth_image.shape[:2]
    bare = patterns.tint(skin, 0.06 * patterns.noise(rng, height, width, (40, 20)))
    cut = int(share * height)
    image = np.concatenate([cloth_image[:cut], bare[cut:]])
    if 0 < cut < height:
        image[cut - 2 : cut] = (image[cut - 2 : cut] * 0.7).astype(np.uint8)
    return np.asarray(image, dtype=np.uint8)


def hair_image(rng: np.random.Generator, colour: Colour) -> Image:
    """Return strands of hair."""
    value = 0.5 * patterns.noise(rng, 64, 128, (40, 2)) + 0.25 * patterns.noise(
        rng, 64, 128, (16, 16)
    )
    return patterns.tint(colour, value)


def face(
    rng: np.random.Generator, skin: Colour, hair: Colour, woman: bool, forehead: float
) -> Image:
    """Return the image round a head from chin to crown, the face in its middle.

    `forehead` tells how far the face reaches up, as a share of the head.
    """
    height, width, k = 224, 384, 3
    image = np.asarray(
        cv2.resize(hair_image(rng, hair), (width * k, height * k)), dtype=np.uint8
    )  # fmt: skip
    tone = patterns.tint(
        skin, 0.08 * patterns.noise(rng, height * k, width * k, (140, 140))
    )  # fmt: skip
    mask = np.zeros((height * k, width * k), dtype=np.uint8)
    # The face, and down to the ears and the nape all round.
    top = int((1 - forehead) * height * k)
    cv2.ellipse(
        mask, (width * k // 2, int(0.62 * height * k)),
        (int(0.17 * width * k), int(0.62 * height * k) - top), 0, 0, 360, 255, -1,
    )  # fmt: skip
    mask[int(0.78 * height * k) :] = 255
    x0, x1 = int(0.33 * width * k), int(0.67 * width * k)
    mask[int(0.62 * height * k) :, x0:x1] = 255
    for ear in (0.27, 0.73):
        centre = int(ear * width * k), int(0.56 * height * k)
        cv2.ellipse(mask, centre, (10 * k, 19 * k), 0, 0, 360, 255, -1)
    image[mask > 0] = tone[mask > 0]
    _features(image, k, skin, hair, woman)
    small = cv2.resize(image, (width, height), interpolation=cv2.INTER_AREA)
    return np.asarray(small, dtype=np.uint8)


def _mix(a: Colour, b: Colour, share: float) -> Colour:
    r, g, blue = (int((1 - share) * x + share * y) for x, y in zip(a, b, strict=True))
    return r, g, blue


def _features(image: Image, k: int, skin: Colour, hair: Colour, woman: bool) -> None:
    """Draw eyes, brows, nose, mouth and ears into an image `k` times as large as the head's."""

    def oval(x: float, y: float, a: float, b: float, colour: Colour) -> None:
        centre = round((192 + x) * k), round(y * k)
        cv2.ellipse(image, centre, (round(a * k), round(b * k)), 0, 0, 360, colour, -1, cv2.LINE_AA)

    shadow, lip = _mix(skin, (40, 16, 10), 0.24), _mix(skin, (150, 30, 40), 0.65 if woman else 0.35)
    brow = _mix(_mix(skin, hair, 0.8), (20, 16, 14), 0.3)
    for side in (-1, 1):
        oval(side * 22, 106, 13, 9, shadow)
        oval(side * 22, 109, 10, 5.2, (236, 232, 228))
        oval(side * 22, 109, 4.8, 4.8, (52, 38, 28))
        oval(side * 22, 103.8, 11.5, 1.8, (36, 26, 22))
        oval(side * 23, 94, 14, 2.2 if woman else 3.4, brow)
        oval(side * 34, 142, 12, 13, _mix(skin, (200, 80, 70), 0.14))
        oval(side * 88, 125, 3, 8, _mix(skin, (40, 16, 10), 0.14))
        oval(side * 6, 147, 4, 2.5, _mix(skin, (30, 10, 8), 0.5))
    oval(0, 149, 13, 3, shadow)
    oval(0, 173, 17, 5.2 if woman else 4.2, lip)
    oval(0, 172.5, 17, 1.1, _mix(lip, (30, 10, 10), 0.6))
    oval(0, 184, 12, 2.0, shadow)
