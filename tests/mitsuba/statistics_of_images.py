"""Whether two sets of independent renders have the same mean."""
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np


def z_scores(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """a and b: runs along the first axis. Welch's t of each difference of means, turned into a normal z.

    Few runs make t wide; [Wallace 1959] gives the z of equal probability to two digits.
    """
    var_a, var_b = a.var(0, ddof=1) / len(a), b.var(0, ddof=1) / len(b)
    difference = a.mean(0) - b.mean(0)
    # Where nothing varies, rounding does: the programs add in other orders, and bytes become colours in other ways.
    floor = 2e-5 * (np.abs(a.mean(0)) + np.abs(b.mean(0))) + 1e-7
    variance = var_a + var_b
    t = difference / np.sqrt(variance + floor**2)
    parts = var_a**2 / (len(a) - 1) + var_b**2 / (len(b) - 1)
    freedom = np.where(parts > 0, variance**2 / np.where(parts > 0, parts, 1), len(a) + len(b) - 2)
    z = (8 * freedom + 1) / (8 * freedom + 3) * np.sqrt(freedom * np.log1p(t * t / freedom))
    return np.sign(t) * np.where(variance > floor**2, z, np.abs(t))


@dataclass
class Verdict:
    relative: np.ndarray  # of the mean of the image, a channel each: ours / Mitsuba's - 1
    noise: np.ndarray  # standard error of that
    largest: float  # |z| of a block of pixels
    limit: float  # for it
    mean_square: float  # of z: about 1
    square_limit: float
    passes: bool


def judge(ours: np.ndarray, theirs: np.ndarray, tolerance: float = 0.01, block: int = 2) -> Verdict:
    """Images as (runs, height, width, 3). The mean of each channel may be off by the tolerance at the most, where the
    noise lets one say so, and no block of pixels by more than chance allows once in 10^4 comparisons."""
    means_ours, means_theirs = ours.mean((1, 2)), theirs.mean((1, 2))
    reference = np.maximum(means_theirs.mean(0), 1e-12)
    relative = means_ours.mean(0) / reference - 1
    noise = np.sqrt(means_ours.var(0, ddof=1) / len(ours) + means_theirs.var(0, ddof=1) / len(theirs)) / reference
    z = z_scores(in_blocks(ours, block), in_blocks(theirs, block)).ravel()
    # Channels share their paths: as many tests count as there are blocks.
    tests = len(z) / 3
    limit = -NormalDist().inv_cdf(0.5e-4 / len(z))
    mean_square = float(np.mean(z * z))
    square_limit = 1 + 6 * np.sqrt(2 / tests)
    largest = float(np.max(np.abs(z)))
    mean_agrees = np.all(np.abs(relative) < np.maximum(tolerance, 4 * noise))
    passes = bool(mean_agrees and largest < limit and mean_square < square_limit)
    return Verdict(relative, noise, largest, limit, mean_square, square_limit, passes)


def in_blocks(images: np.ndarray, block: int) -> np.ndarray:
    """Means over blocks of pixels; what is left over at the right and at the bottom is dropped."""
    runs, height, width, channels = images.shape
    rows, columns = height // block, width // block
    cut = images[:, : rows * block, : columns * block]
    return cut.reshape(runs, rows, block, columns, block, channels).mean((2, 4))
