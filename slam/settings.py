"""All settings of SLAM, with a table for each module."""

from __future__ import annotations

from pydantic import Field

from roomgraph.datasets.settings import Settings
from roomgraph.slam.backend.local_bundle_adjustment import (
    LocalBundleAdjustmentSettings,
)
from roomgraph.slam.backend.loop_closing import LoopSettings
from roomgraph.slam.backend.pose_graph import PoseGraphSettings
from roomgraph.slam.features.extraction import FeatureSettings
from roomgraph.slam.frontend.depth_odometry import DepthOdometrySettings
from roomgraph.slam.frontend.depth_refinement import DepthRefinementSettings
from roomgraph.slam.frontend.keyframe_selection import KeyframeSettings
from roomgraph.slam.frontend.motion_model import PredictionSettings
from roomgraph.slam.frontend.optical_flow import FlowSettings
from roomgraph.slam.frontend.tracker import TrackerSettings
from roomgraph.slam.geometry.icp import IcpSettings
from roomgraph.slam.geometry.motion import MotionSettings
from roomgraph.slam.geometry.noise import SensorNoise
from roomgraph.slam.geometry.planes import PlaneSettings
from roomgraph.slam.reconstruction.floor_plane import FloorPlaneSettings
from roomgraph.slam.reconstruction.occupancy_volume import OccupancyVolumeSettings
from roomgraph.slam.reconstruction.point_map import MapSettings
from roomgraph.slam.relocalisation.word_index import WordIndexSettings


class LossSettings(Settings):
    """Behaviour when tracking is lost."""

    submaps: bool = Field(default=True, description="begin a sub-map where relocalisation fails")
    min_features: int = Field(
        default=100, ge=15, description="minimum number of features with depth to begin a sub-map"
    )
    pause: int = Field(
        default=10, ge=1, description="number of lost frames between attempts to begin a sub-map"
    )
    min_correlation: float = Field(
        default=0.5,
        ge=-1,
        le=1,
        description="minimum correlation of grey levels between a view and its keyframe; below "
        "it, the camera is lost",
    )
    reach_m: float = Field(
        default=1.0,
        gt=0,
        le=100,
        description="a relocalisation within this distance is accepted at once, metres",
    )
    speed_m_s: float = Field(
        default=1.5,
        ge=0,
        le=100,
        description="increase of this distance for each second that the camera was lost, m/s",
    )


class SlamSettings(Settings):
    """All of SLAM's settings."""

    max_depth_m: float = Field(
        default=8.0, gt=0, le=200, description="depth readings beyond are ignored, metres"
    )
    features: FeatureSettings = FeatureSettings()
    noise: SensorNoise = SensorNoise()
    motion: MotionSettings = MotionSettings()
    prediction: PredictionSettings = PredictionSettings()
    flow: FlowSettings = FlowSettings()
    tracker: TrackerSettings = TrackerSettings()
    keyframes: KeyframeSettings = KeyframeSettings()
    local_bundle_adjustment: LocalBundleAdjustmentSettings = LocalBundleAdjustmentSettings()
    planes: PlaneSettings = PlaneSettings()
    icp: IcpSettings = IcpSettings()
    loops: LoopSettings = LoopSettings()
    word_index: WordIndexSettings = WordIndexSettings()
    pose_graph: PoseGraphSettings = PoseGraphSettings()
    depth_refinement: DepthRefinementSettings = DepthRefinementSettings()
    depth_odometry: DepthOdometrySettings = DepthOdometrySettings()
    loss: LossSettings = LossSettings()
    map: MapSettings = MapSettings()
    floor_plane: FloorPlaneSettings = FloorPlaneSettings()
    occupancy_volume: OccupancyVolumeSettings = OccupancyVolumeSettings()
