"""Localisation of the camera by the cheapest method that works."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets import se3
from roomgraph.slam.features.view import View
from roomgraph.slam.frontend.depth_odometry import DepthOdometry
from roomgraph.slam.frontend.depth_refinement import DepthRefiner
from roomgraph.slam.frontend.estimate import Estimate, inverted
from roomgraph.slam.frontend.local_map import LocalMap
from roomgraph.slam.frontend.motion_model import MotionModel
from roomgraph.slam.frontend.optical_flow import FlowTracker, Template
from roomgraph.slam.frontend.tracker import Located, Tracker
from roomgraph.slam.frontend.tracking_status import TrackingStatus
from roomgraph.slam.geometry.overlap import overlap
from roomgraph.slam.geometry.range_image import RangeImage
from roomgraph.slam.tracking import Anchor

FloatArray = NDArray[np.float64]


class KnownMap(Protocol):
    """The present map, as the localiser needs it."""

    @property
    def poses(self) -> Mapping[int, FloatArray]:
        """T_world_keyframe (4, 4) by keyframe id."""

    def around(self, reference: int) -> LocalMap:
        """Return the local map of a keyframe."""

    def thumbnail(self, keyframe: int) -> RangeImage:
        """Return the thumbnail of a keyframe."""


class Localiser:
    """Tracks the camera from frame to frame: by optical flow, by features, by depth alone.

    Parameters
    ----------
    flow, tracker, depth : FlowTracker, Tracker, DepthOdometry
        The three means, in the order in which they are tried.
    motion : MotionModel
        What to expect, and what to hold on to where a view leaves something open.
    refiner : DepthRefiner
        What improves poses that few features hold.
    known : KnownMap
        The keyframes to go by.
    status : TrackingStatus
        Whether the last frame has a pose; read only.
    min_correlation : float
        Of a view found by features with its keyframe, at least.
    """

    def __init__(
        self,
        flow: FlowTracker,
        tracker: Tracker,
        depth: DepthOdometry,
        motion: MotionModel,
        refiner: DepthRefiner,
        known: KnownMap,
        status: TrackingStatus,
        min_correlation: float,
    ) -> None:
        self.flow, self.tracker, self.depth = flow, tracker, depth
        self.motion, self.refiner = motion, refiner
        self._map, self._status, self._min_correlation = known, status, min_correlation
        self._template: Template | None = None
        self._template_covariance: FloatArray = np.zeros((6, 6))
        self._last: Anchor | None = None
        self._last_view: View | None = None
        self._covariance: FloatArray = np.zeros((6, 6))

    def locate(self, view: View) -> Estimate | None:
        """Return the pose of a view, tracked from the last one; None if all methods fail.

        A view without any depth can be followed by its corners, but it is not worth more effort:
        nothing could be mapped from it.
        """
        seen = self._by_flow(view)
        if seen is None and view.has_depth:
            seen = self._by_features(view) or self._by_flow_from_last(view)
        if seen is not None:
            return self._held(view, self.refiner.refine(view.frame, seen))
        return self._by_depth(view) if view.has_depth else None

    def moved_to(self, view: View, anchor: Anchor, estimate: Estimate | None) -> None:
        """Set the present pose to that of a view.

        Parameters
        ----------
        view, anchor : View, Anchor
            Now, and where that is.
        estimate : Estimate or None
            What it was found by; None if it is where it is by definition: a keyframe.
        """
        if self._last is not None and self._status.is_tracking:
            T_camera_world = se3.inverse(self._pose_of(anchor))
            self.motion.moved(T_camera_world @ self._pose_of(self._last), self._since(view))
        self._covariance = np.zeros((6, 6)) if estimate is None else estimate.covariance
        if estimate is None or estimate.method != "depth":
            self.depth.forget()
        if estimate is None:
            self.refiner.rest_on(anchor.keyframe, view.frame)
        self._last, self._last_view = anchor, view

    def follow(self, view: View, anchor: Anchor) -> Template:
        """Use this view as the template of optical flow."""
        self._template = self.flow.template(view, anchor)
        self._template_covariance = self._covariance
        return self._template

    @property
    def T_world_camera(self) -> FloatArray:
        """Where the camera (4, 4) was last, as estimated now."""
        assert self._last is not None
        return self._pose_of(self._last)

    def stand_still(self) -> None:
        """Predict no motion, since the last motion is unknown."""
        self.motion.stand_still()

    def _pose_of(self, anchor: Anchor) -> FloatArray:
        return np.asarray(self._map.poses[anchor.keyframe] @ anchor.T_keyframe_camera)

    def _since(self, view: View) -> float:
        """Return the seconds since the last view; 0 before there is one."""
        return (
            0.0 if self._last_view is None else view.frame.stamp_s - self._last_view.frame.stamp_s
        )

    def _prediction(self, view: View, target: Anchor) -> FloatArray:
        """Return T_camera_target if the camera goes on as it did."""
        assert self._last is not None
        T = (
            self.motion.step(self._since(view))
            @ se3.inverse(self._pose_of(self._last))
            @ self._pose_of(target)
        )
        # A prediction feeds the next one: left alone, rounding errors double with each frame.
        return se3.orthonormal(T)

    def _held(self, view: View, estimate: Estimate) -> Estimate:
        """Constrain a pose by the motion model where the view does not."""
        if not self._status.is_tracking:
            return estimate
        T = self.motion.hold(
            estimate.T_camera_reference, estimate.information,
            self._prediction(view, Anchor(estimate.reference, np.eye(4))), self._since(view),
        )  # fmt: skip
        return replace(estimate, T_camera_reference=T)

    def _by_flow(self, view: View) -> Estimate | None:
        """Track the corners of the template."""
        if self._template is None:
            return None
        return self._followed(view, self._template, self._template_covariance)

    def _by_flow_from_last(self, view: View) -> Estimate | None:
        """Track the corners of the last view, which has similar blur in quick motion."""
        if self._last is None or self._last_view is None or not self._last_view.has_depth:
            return None
        if self._template is not None and self._template.grey is self._last_view.grey:
            return None
        template = self.flow.template(self._last_view, self._last)
        return self._followed(view, template, self._covariance)

    def _followed(
        self, view: View, template: Template, template_covariance: FloatArray
    ) -> Estimate | None:
        if not self.flow.settings.enabled:
            return None
        followed = self.flow.track(view, template, self._prediction(view, template.anchor))
        if followed is None:
            return None
        motion, seen = followed
        T = motion.T_camera_reference
        carried = se3.adjoint(T) @ template_covariance @ se3.adjoint(T).T
        covariance = inverted(motion.information) + carried
        return Estimate(
            reference=template.anchor.keyframe,
            T_camera_reference=T @ se3.inverse(template.anchor.T_keyframe_camera),
            information=np.asarray(np.linalg.inv(covariance)),
            inliers=motion.count,
            support=motion.count / len(template.pixels),
            method="flow",
            pixels=seen,
        )

    def _by_features(self, view: View) -> Estimate | None:
        """Match features with the local map."""
        assert self._last is not None
        reference = self._last.keyframe
        located = self.tracker.track(
            view, self._map.around(reference), self._prediction(view, Anchor(reference, np.eye(4)))
        )
        if located is None or not self._looks_right(view, located):
            return None
        return estimate_of(located, view)

    def _looks_right(self, view: View, located: Located) -> bool:
        """Whether the keyframe with most matches looks the same from that pose.

        If not, they match a pattern that repeats: the camera has jumped, and is to be found anew.
        """
        owners = located.matches_by_owner()
        nearest = max(owners, key=lambda keyframe: owners[keyframe])
        T_world_reference, T_world_nearest = (
            self._map.poses[keyframe] for keyframe in (located.local_map.reference, nearest)
        )
        T_reference_nearest = se3.inverse(T_world_reference) @ T_world_nearest
        common = overlap(
            self._map.thumbnail(nearest), view.thumbnail,
            located.motion.T_camera_reference @ T_reference_nearest,
        )  # fmt: skip
        return common.looks_alike(self._min_correlation)

    def _by_depth(self, view: View) -> Estimate | None:
        """Track from the last frame by aligning depth images."""
        if not self.depth.settings.enabled or self._last is None or self._last_view is None:
            return None
        if not self.depth.is_tracking:
            self.depth.remember(self._last_view.frame)
        step = self.depth.register(
            view.frame,
            self.motion.step(self._since(view)),
            is_textured=int(view.has_point.sum()) >= self.depth.settings.texture,
        )
        if step is None:
            return None
        # The step's error comes on top of that of the pose it starts from.
        carried = se3.adjoint(step.T_camera_last)
        covariance: FloatArray = carried @ self._covariance @ carried.T + inverted(step.information)
        return Estimate(
            reference=self._last.keyframe,
            T_camera_reference=step.T_camera_last @ se3.inverse(self._last.T_keyframe_camera),
            information=np.asarray(np.linalg.inv(covariance)),
            inliers=0,
            support=0.0,
            method="depth",
            pixels=np.empty((0, 2)),
        )


def estimate_of(located: Located, view: View) -> Estimate:
    """Return a pose by features in the form that all poses share."""
    could = max(1, int(view.has_point.sum()))
    return Estimate(
        reference=located.local_map.reference,
        T_camera_reference=located.motion.T_camera_reference,
        information=located.motion.information,
        inliers=located.inliers,
        support=located.inliers / could,
        method="features",
        pixels=view.features.pixels[located.matches[:, 1]],
    )
