"""What tests of several packages share."""


def frames_of(sequence):
    """Yield all frames in order."""
    for index in range(len(sequence)):
        yield sequence[index]
