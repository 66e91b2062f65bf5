# Renders a model with Cycles: blender -b --factory-startup --python cycles.py -- MODEL VIEW PNG [SAMPLES], the view as
# flags of facemap render. Lights fade with the square of the distance in Cycles; unless the flags say so too, they are
# given the strength that they have at the point that the camera looks at. Prints the seconds that reading and
# rendering take.
import os
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy
from mathutils import Vector

import cycles_scene

model, view_file, picture, *rest = sys.argv[sys.argv.index("--") + 1 :]
words = open(view_file).read().split()
flags = list(zip(words[::2], words[1::2]))
view = dict(flags)


def numbers(text):
    return [float(number) for number in text.split(",")]


start = time.perf_counter()
cycles_scene.import_model(model)
camera = {name: numbers(view[name]) for name in ("--camera", "--look-at", "--up", "--field-angle")}
size = [int(side) for side in view.get("--size", "1024x1024").split("x")]
cycles_scene.look(camera["--camera"], camera["--look-at"], camera["--up"], camera["--field-angle"][0], size)
for name, value in flags:
    if name != "--light":
        continue
    light = cycles_scene.add_point_light(numbers(value)[:3], numbers(value)[3:])
    if view.get("--falloff") != "inverse-square":
        light.data.energy *= (light.location - Vector(camera["--look-at"])).length_squared
cycles_scene.use_cycles(2)
cycles_scene.diffuse_only()
cycles_scene.sample_pixels(int(rest[0]) if rest else 1)
bpy.context.scene.render.image_settings.file_format = "PNG"
bpy.context.scene.render.filepath = picture
read = time.perf_counter()
bpy.ops.render.render(write_still=True)
print(f"seconds: {read - start:.3f} reading, {time.perf_counter() - read:.3f} rendering")
