"""A small model that many tests of this folder look with."""

import pytest

from tests.semantics.helpers import tiny_model


@pytest.fixture(scope="session")
def model():
    return tiny_model()
