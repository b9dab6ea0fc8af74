"""Tests whether two sets of independent renders have the same mean."""
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np


def z_scores(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Returns Welch's t of each difference of means, converted to a z score. The first axis of a and b are the runs.

    t of few runs has wide tails. [Wallace 1959] gives the z of equal probability to two digits.
    """
    var_a, var_b = a.var(0, ddof=1) / len(a), b.var(0, ddof=1) / len(b)
    difference = a.mean(0) - b.mean(0)
    # Pixels without variance differ by rounding: the programs add in other orders, and convert bytes in other ways.
    floor = 2e-5 * (np.abs(a.mean(0)) + np.abs(b.mean(0))) + 1e-7
    variance = var_a + var_b
    t = difference / np.sqrt(variance + floor**2)
    parts = var_a**2 / (len(a) - 1) + var_b**2 / (len(b) - 1)
    freedom = np.where(parts > 0, variance**2 / np.where(parts > 0, parts, 1), len(a) + len(b) - 2)
    z = (8 * freedom + 1) / (8 * freedom + 3) * np.sqrt(freedom * np.log1p(t * t / freedom))
    return np.sign(t) * np.where(variance > floor**2, z, np.abs(t))


@dataclass
class Verdict:
    relative: np.ndarray  # mean of each channel, Tessera's / Mitsuba's - 1
    noise: np.ndarray  # standard error of `relative`
    largest: float  # largest |z| of a block of pixels
    limit: float  # of `largest`
    mean_square: float  # of z; expected to be 1
    square_limit: float  # of `mean_square`
    passes: bool


def judge(tessera: np.ndarray, mitsuba: np.ndarray, tolerance: float = 0.01, block: int = 2) -> Verdict:
    """Compares images of shape (runs, height, width, 3).

    They agree if the mean of each channel differs by less than `tolerance`, or four standard errors if that is more.
    Also, the largest |z| of the blocks must be below the limit that chance exceeds once in 10^4 comparisons, and the
    mean of z^2 below 1 plus six standard deviations.
    """
    tessera_means, mitsuba_means = tessera.mean((1, 2)), mitsuba.mean((1, 2))
    reference = np.maximum(mitsuba_means.mean(0), 1e-12)
    relative = tessera_means.mean(0) / reference - 1
    noise = np.sqrt(tessera_means.var(0, ddof=1) / len(tessera) + mitsuba_means.var(0, ddof=1) / len(mitsuba)) / reference
    z = z_scores(in_blocks(tessera, block), in_blocks(mitsuba, block)).ravel()
    # The channels of a block are correlated, as they share paths. They count as one test.
    tests = len(z) / 3
    limit = -NormalDist().inv_cdf(0.5e-4 / len(z))
    mean_square = float(np.mean(z * z))
    square_limit = 1 + 6 * np.sqrt(2 / tests)
    largest = float(np.max(np.abs(z)))
    mean_agrees = np.all(np.abs(relative) < np.maximum(tolerance, 4 * noise))
    passes = bool(mean_agrees and largest < limit and mean_square < square_limit)
    return Verdict(relative, noise, largest, limit, mean_square, square_limit, passes)


def in_blocks(images: np.ndarray, block: int) -> np.ndarray:
    """Returns the means over blocks of pixels, without incomplete blocks at the right and at the bottom."""
    runs, height, width, channels = images.shape
    rows, columns = height // block, width // block
    cut = images[:, : rows * block, : columns * block]
    return cut.reshape(runs, rows, block, columns, block, channels).mean((2, 4))
