"""A URDF with its rounded angles replaced by what they stand for, as docs/urdf.md says: rpy="1.5708 0 0" is a quarter turn.

Pinocchio would turn by 1.5708 rad, 3.7e-6 rad more: another robot, of which no exact solver of the first finds the joint values.
"""

import math
import re
from decimal import ROUND_DOWN, ROUND_HALF_EVEN, Decimal

STEP = Decimal("3.14159265358979323846264338327950288419716939937511") / 12
UNIT = [Decimal(square).sqrt() for square in ("0", "0.25", "0.5", "0.75", "1")]
FEWEST, MOST = 4, 24
"""Decimals that a rounded number may have."""


def urdf(text: str) -> str:
    """The whole description."""
    text = re.sub(r"(<origin\b[^>]*?\brpy\s*=\s*[\"'])([^\"']*)", lambda match: match[1] + _each(match[2], _angle), text)
    return re.sub(r"(<axis\b[^>]*?\bxyz\s*=\s*[\"'])([^\"']*)", lambda match: match[1] + _axis(match[2]), text)


def _each(words: str, change) -> str:
    return " ".join(map(change, words.split()))


def _angle(word: str) -> str:
    """The multiple of pi/4 or pi/6 of which a word is the decimal, or the word."""
    if not _is_number(word):
        return word
    turns = round(Decimal(word) / STEP)
    is_step = turns % 2 == 0 or turns % 3 == 0
    return repr(float(turns * STEP)) if is_step and _is_decimal_of(Decimal(word), turns * STEP) else word


def _axis(words: str) -> str:
    """The unit vector of 0, 1/2, sqrt 2 / 2, sqrt 3 / 2 and 1 of which an axis is the decimal, or the axis."""
    numbers = [_entry(Decimal(word)) for word in words.split() if _is_number(word)]
    if len(numbers) != 3 or None in numbers or abs(sum(number * number for number in numbers) - 1) > Decimal("1e-20"):
        return words
    return " ".join(repr(float(number)) for number in numbers)


def _entry(given: Decimal) -> Decimal | None:
    size = next((unit for unit in UNIT if _is_decimal_of(abs(given), unit)), None)
    return None if size is None else size.copy_sign(given)


def _is_number(word: str) -> bool:
    """Whether a word is a decimal number. (Visuals may have macros that nobody expanded.)"""
    return re.fullmatch(r"[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?", word, re.IGNORECASE) is not None


def _is_decimal_of(given: Decimal, exact: Decimal) -> bool:
    """Whether a number is another's rounded or truncated decimal, or its double."""
    if math.isclose(given, exact, rel_tol=0, abs_tol=1e-15):
        return True
    place = given.normalize().as_tuple().exponent
    if not FEWEST <= -place <= MOST:
        return False
    return given in (exact.quantize(Decimal(1).scaleb(place), way) for way in (ROUND_HALF_EVEN, ROUND_DOWN))
