# %% [markdown]
# # What is seen of a landscape
#
# Two towers on hills, 12 metres high: what of the land does neither of them see, one of them, both?

# %%
import numpy as np
import shapes

import facemap

# %% Some hills on a grid of 20 metres.
random = np.random.default_rng(11)
row, column = np.mgrid[0:150, 0:200]
heights = np.zeros(row.shape)
for size in np.geomspace(30, 3, 260):
    at = random.uniform((0, 0), (150, 200))
    heights += random.normal() * 3.5 * size * np.exp(-((row - at[0]) ** 2 + (column - at[1]) ** 2) / (2 * size**2))
land = facemap.terrain(heights, spacing=20)

# %% Towers on the highest points of the western and the eastern half.
peaks = [np.unravel_index(np.where(half, heights, 0).argmax(), heights.shape) for half in (column < 80, column > 120)]
towers = [(20 * c, 0, 20 * r) for r, c in peaks]
counts = facemap.viewshed(land, towers, eye_height=12)
print(f"{(counts == 0).mean():.0%} of the land is seen from neither, {(counts == 2).mean():.0%} from both")

# %% The same for each point that a camera sees.
camera = facemap.Camera((1500, 2500, 4600), look_at=(2020, 0, 1450), lens="plane", field_angle=36)
frame, is_seen, points, faces = shapes.seen_points(land, camera, 480, 320)
counts = facemap.viewshed(land, towers, points, eye_height=12, faces=faces)
shapes.save("viewshed.png", shapes.picture(frame, is_seen, shapes.colours(counts / 2, ["#41506b", "#8fae5b", "#f7e08a"])))
