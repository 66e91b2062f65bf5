# %% [markdown]
# # What lamps reach
#
# Six lamps over an office with partitions: the illuminance on every surface in steps, and where a seventh is missing.

# %%
import numpy as np
import shapes

import facemap

# %% A floor of 12 by 8 metres, partitions of 1.6 metres, and desks.
walls = [((-2, 0, -4), (-1.9, 1.6, 1)), ((2, 0, -1), (2.1, 1.6, 4)), ((-6, 0, 1), (-1.9, 1.6, 1.1)),
         ((2, 0, -1.1), (4.5, 1.6, -1))]
desks = [((x, 0.7, z), (x + 1.6, 0.74, z + 0.8)) for x in (-5, -0.8, 3) for z in (-2.8, 2.2)]
lower, upper = np.array(walls + desks, float).transpose(1, 0, 2)
room = facemap.Scene([[-6, 0, -4], [6, 0, -4], [6, 0, 4], [-6, 0, 4]], [[0, 2, 1], [0, 3, 2]])
room.add(facemap.Scene(*shapes.boxes(lower, upper)))

# %% Spots below the ceiling; 1200 candela each, so that what comes out is in lux.
lamps = [facemap.Light.spot((x, 2.6, z), (0, -1, 0), outer_angle=62, inner_angle=25, intensity=1200)
         for x in (-4.2, 0, 4) for z in (-2, 2)]

# %%
camera = facemap.Camera((6.5, 10, 11.5), look_at=(0, 0, 0.4), lens="plane", field_angle=36)
frame, is_seen, points, faces = shapes.seen_points(room, camera, 480, 320)
lit, irradiance = facemap.lamp_coverage(room, points, lamps, frame.face_normal[is_seen], faces=faces)
lux = irradiance[:, 0]
print(f"up to {lux.max():.0f} lux; {(~lit.any(axis=0)).mean():.1%} of what is seen gets light from no lamp")

# %% In steps of 50 lux.
shapes.save("lamp_coverage.png", shapes.picture(frame, is_seen, shapes.colours(np.floor(lux / 50) * 50 / 400)))
