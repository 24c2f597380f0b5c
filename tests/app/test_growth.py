"""A gate for what is drawn as it grows: at once, then by steps, then by shares."""

from app.growth import GrowthGate


def test_it_opens_for_the_first_and_then_by_steps_and_shares():
    gate = GrowthGate(5, 10)
    assert [size for size in range(0, 31) if gate.opens(size)] == [1, 6, 11, 16, 21, 26]
    large = [size for size in range(30, 200) if gate.opens(size)]
    assert large[:6] == [31, 36, 41, 46, 51, 56]
    assert large[-3:] == [151, 166, 182]


def test_all_drawings_of_a_large_thing_are_a_few_times_the_last():
    gate = GrowthGate(1, 16)
    drawn = [size for size in range(5000) if gate.opens(size)]
    assert sum(drawn) < 18 * drawn[-1]
    assert not gate.opens(drawn[-1] - 1)
