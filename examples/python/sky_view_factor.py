# %% [markdown]
# # How much sky there is
#
# The sky view factor of every point of a little city that a camera sees: 1 on an open roof, little in a narrow street.

# %%
import shapes

import facemap

city = shapes.city()
camera = facemap.Camera((95, 150, 165), look_at=(0, 0, 8), lens="plane", field_angle=35)

# %% Which point of which face does each pixel show?
frame, is_seen, points, faces = shapes.seen_points(city, camera, 480, 320)
normals = frame.face_normal[is_seen]

# %% The sky over each of them. A point lies on its face up to rounding: that face never hides the sky.
factor = facemap.sky_view_factor(city, points, normals, directions=192, faces=faces)
print(f"sky view factors from {factor.min():.2f} to {factor.max():.2f}")

# %%
shapes.save("sky_view_factor.png", shapes.picture(frame, is_seen, shapes.colours(factor)))
