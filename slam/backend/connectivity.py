"""Connectivity of keyframes: the pose graph without its poses."""

from __future__ import annotations

import heapq


class Connections:
    """Keyframes, the path lengths between linked ones, and their connected components.

    A component is named after its root, the keyframe that it is held by: its oldest. Keyframes
    that hang on nothing held yet are loose.
    """

    def __init__(self) -> None:
        self.roots: set[int] = set()
        self.loose: set[int] = set()
        self._component: dict[int, int] = {}
        self._members: dict[int, list[int]] = {}
        self._ways: dict[int, dict[int, list[float]]] = {}

    def __contains__(self, keyframe: int) -> bool:
        return keyframe in self._component

    def add(self, keyframe: int, is_root: bool) -> None:
        """Add a keyframe without constraints."""
        (self.roots if is_root else self.loose).add(keyframe)
        self._component[keyframe] = keyframe
        self._members[keyframe] = [keyframe]
        self._ways[keyframe] = {}

    def component_of(self, keyframe: int) -> int:
        """Return the root of a keyframe's component."""
        return self._component[keyframe]

    def members_of(self, root: int) -> list[int]:
        """Return the keyframes of the component with this root."""
        return list(self._members[root])

    def connected(self, keyframe: int) -> list[int]:
        """Return the keyframes that a keyframe is linked to."""
        return list(self._ways[keyframe])

    def connect(self, first: int, second: int, metres: float) -> list[int]:
        """Connect two keyframes; return those of the younger component if both were fixed."""
        self._ways[first].setdefault(second, []).append(metres)
        self._ways[second].setdefault(first, []).append(metres)
        ends = {self._component[first], self._component[second]}
        if len(ends) == 1:
            return []
        kept, other = sorted(ends, key=lambda root: (root not in self.roots, root))
        members = self._members.pop(other)
        self._component.update(dict.fromkeys(members, kept))
        self._members[kept].extend(members)
        if other in self.roots:
            self.roots.remove(other)
            return members
        if kept in self.roots:
            self.loose.difference_update(members)
        return []

    def disconnect(self, first: int, second: int, metres: float) -> bool:
        """Disconnect two keyframes; return whether this splits a component into two fixed ones."""
        for end, other in ((first, second), (second, first)):
            self._ways[end][other].remove(metres)
            if not self._ways[end][other]:
                del self._ways[end][other]
        root = self._component[first]
        reached = self._reach(root)
        apart = sorted(set(self._members[root]) - reached)
        if not apart:
            return False
        self._members[root] = [k for k in self._members[root] if k in reached]
        self._members[apart[0]] = apart
        self._component.update(dict.fromkeys(apart, apart[0]))
        self.roots.add(apart[0])
        return True

    def ways_from(self, keyframe: int, limit: float, goal: int | None = None) -> dict[int, float]:
        """Return the keyframes within `limit` metres along constraints, with distances (Dijkstra).

        With a goal, the search ends there.
        """
        queue, best, done = [(0.0, keyframe)], {keyframe: 0.0}, dict[int, float]()
        while queue and goal not in done:
            metres, nearest = heapq.heappop(queue)
            if nearest in done:
                continue
            done[nearest] = metres
            for other, ways in self._ways[nearest].items():
                total = metres + min(ways)
                if total <= limit and total < best.get(other, float("inf")):
                    best[other] = total
                    heapq.heappush(queue, (total, other))
        return done

    def _reach(self, start: int) -> set[int]:
        reached, waiting = {start}, [start]
        while waiting:
            fresh = [k for k in self._ways[waiting.pop()] if k not in reached]
            reached.update(fresh)
            waiting.extend(fresh)
        return reached
