import sys
from pathlib import Path

import numpy as np
import pytest

import groebot

sys.path.insert(0, str(Path(__file__).parent))


@pytest.fixture
def random():
    return np.random.default_rng(1)


@pytest.fixture(scope="session")
def derived():
    """The solver of a UR5 URDF, derived once for all tests, because it is immutable."""
    from witness import UR5_URDF

    return groebot.derive(groebot.Robot.from_urdf(UR5_URDF))


@pytest.fixture(scope="session")
def panda():
    """The redundant solver of a Panda, derived once for all tests."""
    from witness import PANDA_URDF

    return groebot.derive(PANDA_URDF)
