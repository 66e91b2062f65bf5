# %% [markdown]
# # Hours of sun
#
# How long the sun shines on each point of a little city on a day of March, at 48 degrees north.

# %%
import numpy as np
import shapes

import facemap

city = shapes.city()
camera = facemap.Camera((95, 150, 165), look_at=(0, 0, 8), lens="plane", field_angle=35)


# %% The sun's way over the sky; x is east, y is up and z is south.
def sun_directions(latitude, day, hours):
    declination = np.radians(-23.44) * np.cos(2 * np.pi * (day + 10) / 365)  # Cooper's formula, as a cosine
    turn, phi = np.radians(15 * (hours - 12)), np.radians(latitude)
    east = -np.cos(declination) * np.sin(turn)
    up = np.sin(phi) * np.sin(declination) + np.cos(phi) * np.cos(declination) * np.cos(turn)
    south = np.sin(phi) * np.cos(declination) * np.cos(turn) - np.cos(phi) * np.sin(declination)
    return np.stack([east, up, south], axis=1)


step = 0.25
suns = sun_directions(48, 80, np.arange(step / 2, 24, step))

# %% Which points the camera sees, and for how long the sun shines there. What is below the horizon does not count.
frame, is_seen, points, faces = shapes.seen_points(city, camera, 480, 320)
hours = facemap.sun_hours(city, points, suns, step, frame.face_normal[is_seen], faces=faces)
print(f"from {hours.min():.2f} to {hours.max():.2f} hours")

# %%
shapes.save("sun_hours.png", shapes.picture(frame, is_seen, shapes.colours(hours / 12)))
