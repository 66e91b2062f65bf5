# %% [markdown]
# # Four fisheye cameras on a car
#
# Calibrated as OpenCV has it: a camera matrix, four coefficients and a pose each; 190 degrees across.

# %%
import numpy as np
import shapes

import facemap

city = shapes.city()
city.add(facemap.Scene(*shapes.boxes([[-16, 0.3, 12.8]], [[-14.2, 1.5, 17]]), color="#b3402e"))  # the car
lights = [facemap.Light.sun((-0.25, -1.3, -1), intensity=0.5)]

# %% The same lens for all, and four poses: camera = R body + t. The body looks along its z axis, with y down.
side = max(16, round(200 * shapes.SCALE))
focal = side / np.radians(200)
K = np.array([[focal, 0, side / 2], [0, focal, side / 2], [0, 0, 1]])
D = [-0.01, 0.002, 0, 0]


def camera_pose(degrees, place, pitch=15):
    """Of a camera at a place of the body that looks `degrees` to the right, and down."""
    a, b = np.radians([degrees, pitch])
    turn = np.array([[np.cos(a), 0, -np.sin(a)], [0, 1, 0], [np.sin(a), 0, np.cos(a)]])
    tilt = np.array([[1, 0, 0], [0, np.cos(b), -np.sin(b)], [0, np.sin(b), np.cos(b)]])
    pose = np.eye(4)
    pose[:3, :3] = tilt @ turn
    pose[:3, 3] = -pose[:3, :3] @ place
    return pose


poses = [camera_pose(0, (0, -0.8, 2.4)), camera_pose(90, (1.2, -1.1, 0.6)), camera_pose(180, (0, -0.9, -2.4)),
         camera_pose(-90, (-1.2, -1.1, 0.6))]

# %% The body stands in the street and looks to the north, along -z: body = R world + t.
rig = np.diag([1.0, -1, -1, 1])
rig[:3, 3] = -rig[:3, :3] @ (-15.1, 0, 14.9)
frames = facemap.camera_rig(city, np.broadcast_to(K, (4, 3, 3)), D, poses, side, side, rig=rig, lights=lights,
                            samples="edges", sky_up=(0.3, 0.38, 0.5), sky_down=(0.1, 0.09, 0.08),
                            background="#a9c4e4")

# %% Ahead, right, back and left.
shapes.save("camera_rig.png", np.concatenate([frame.image for frame in frames], axis=1))
