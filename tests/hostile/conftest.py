"""The process that the tests of a session send their inputs to."""

import pytest

from .pool import Pool


@pytest.fixture(scope="session")
def pool(tmp_path_factory):
    """See ``Pool``."""
    pool = Pool(tmp_path_factory.mktemp("hostile"))
    yield pool
    pool.close()
