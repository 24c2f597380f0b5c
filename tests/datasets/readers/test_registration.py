import numpy as np
import pytest

from roomgraph.datasets import se3
from roomgraph.datasets.camera import Camera, DepthCamera, Intrinsics
from roomgraph.datasets.errors import DatasetError
from roomgraph.datasets.readers.registration import rectify, register

COLOUR = Intrinsics(320, 240, 262.0, 262.0, 159.5, 119.5)
# A Kinect's two eyes, at half their size: another focal length, 25 mm and a degree apart.
T_COLOUR_DEPTH = se3.pose(
    np.array([[0.99985, 0, 0.01745], [0, 1, 0], [-0.01745, 0, 0.99985]]), np.array([-0.025, 0, 0])
)


def measured(camera, T_colour_camera):
    """Return the exact depth (H, W) of a slanted wall and a board before it, metres."""
    rows, columns = np.mgrid[: camera.height, : camera.width]
    pixels = np.column_stack([columns.ravel(), rows.ravel()]).astype(float)
    rays = camera.backproject(pixels, np.ones(len(pixels))) @ T_colour_camera[:3, :3].T
    eye = T_colour_camera[:3, 3]
    normal = np.array([0.3, 0.1, 1.0])
    wall = (3.0 - eye @ normal) / (rays @ normal)
    board = (1.2 - eye[2]) / rays[:, 2]
    x, y = (eye + board[:, None] * rays)[:, :2].T
    is_board = (np.abs(x) < 0.25) & (np.abs(y) < 0.2)
    # Along the optical axis, a ray of z = 1 is as long as the depth.
    return np.where(is_board, board, wall).reshape(camera.height, camera.width).astype(np.float32)


@pytest.mark.parametrize(
    ("own", "covered", "error_m"),
    [
        (Intrinsics(320, 240, 292.0, 292.0, 159.5, 119.5), 0.99, 0.004),
        (Intrinsics(160, 120, 125.0, 125.0, 79.5, 59.5), 0.99, 0.004),
        (Intrinsics(64, 48, 50.0, 50.0, 31.5, 23.5), 0.97, 0.006),
    ],
)
def test_depth_is_laid_where_the_colour_camera_sees_it(own, covered, error_m):
    depth = measured(own, T_COLOUR_DEPTH)
    laid, true = (
        register(depth, DepthCamera(own, T_COLOUR_DEPTH), COLOUR),
        measured(COLOUR, np.eye(4)),
    )
    # Off the sides, which the narrower camera does not see, and off the board's edges.
    inside = np.zeros(laid.shape, bool)
    inside[24:-24, 30:-30] = True
    across = np.abs(np.diff(true, axis=1, prepend=true[:, :1])) > 0.5
    down = np.abs(np.diff(true, axis=0, prepend=true[:1])) > 0.5
    edge = np.pad(across | down, 12)
    near_edge = np.lib.stride_tricks.sliding_window_view(edge, (25, 25)).any(axis=(2, 3))
    compared = inside & ~near_edge
    assert compared.mean() > 0.3
    assert (laid[compared] > 0).mean() > covered
    known = compared & (laid > 0)
    difference = laid[known] - true[known]
    assert np.abs(difference).max() < 0.05
    assert np.sqrt(np.mean(difference**2)) < error_m
    assert abs(difference.mean()) < error_m / 4
    # Nothing hangs in the air between board and wall.
    seen = laid[inside & (laid > 0)]
    assert not ((seen > 1.3) & (seen < true[~near_edge & (true > 1.3)].min() - 0.1)).any()


def test_the_nearer_surface_hides_the_farther():
    own = Intrinsics(320, 240, 262.0, 262.0, 159.5, 119.5)
    depth = np.full((240, 320), 4.0, np.float32)
    depth[80:160, 100:200] = 0.5
    T = np.eye(4)
    T[0, 3] = -0.1
    laid = register(depth, DepthCamera(own, T), COLOUR)
    # Ten centimetres to the left at half a metre: 52 pixels. Uncovered wall was never seen.
    assert (laid[82:158, 50:145] == 0.5).all()
    assert (laid[82:158, 150:190] == 0).all()


def test_a_wrong_size_tells_of_depth_cameras(tmp_path):
    camera = Camera(COLOUR, 1000.0, "made up")
    colour, depth = np.zeros((240, 320, 3), np.uint8), np.ones((48, 64), np.float32)
    with pytest.raises(DatasetError, match=r"320x240.*64x48.*separate depth camera"):
        rectify(colour, depth, camera, tmp_path / "d.png")
