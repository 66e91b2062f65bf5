# %% [markdown]
# # A spinning LiDAR in a street
#
# 32 rings on a car's roof: above what the device measures, by ring and azimuth; below the points from above. Where the
# ground is flat each ring is a circle.

# %%
import numpy as np
import shapes

import facemap

city = shapes.city()

# %% The sensor stands at a crossing, 1.9 metres high; its x axis looks along the street, its z axis is the world's y.
pose = np.eye(4)
pose[:3, :3] = np.array([[0.0, 1, 0], [0, 0, 1], [1, 0, 0]])
pose[:3, 3] = (-15, 1.9, 15)
step = 0.5 / min(1, shapes.SCALE)
elevations = np.linspace(-25, 15, 32)
scan = facemap.lidar(city, pose, elevations, np.arange(180, -180, -step), max_range=70)
print(f"{(scan.faces >= 0).mean():.0%} of {scan.faces.size} beams return")

# %% Ranges as an image: a row a ring, the highest at the top.
near = np.where(scan.faces[::-1] < 0, 1, 1 - scan.ranges[::-1] / 70)
strip = np.where((scan.faces[::-1] < 0)[..., None], 1, shapes.colours(near))
strip = np.repeat(strip, 3, axis=0)

# %% The points from above, in metres about the sensor, by height.
width = strip.shape[1]
cloud = scan.points[scan.faces >= 0]
place = np.round((cloud[:, [0, 2]] - pose[[0, 2], 3]) * (width / 120) + [width / 2, width / 4]).astype(int)
is_in = (place >= 0).all(axis=1) & (place < [width, width // 2]).all(axis=1)
plan = np.full((width // 2, width, 3), 0.1)
order = np.argsort(cloud[is_in, 1])
x, y = place[is_in][order].T
plan[y, x] = shapes.colours(0.25 + np.clip(cloud[is_in, 1][order] / 20, 0, 0.75))

# %%
shapes.save("lidar.png", np.round(255 * np.concatenate([strip, plan])).astype(np.uint8))
