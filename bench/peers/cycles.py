# Renders an OBJ with Cycles at one sample a pixel: blender -b --python cycles.py -- OBJ VIEW PNG, the view as flags of
# facemap render. Lights fall off with the square of the distance in Cycles; they are given the strength that they
# have at the point that the camera looks at.
import math
import sys

import bpy
from mathutils import Matrix, Vector

model, view_file, picture = sys.argv[sys.argv.index("--") + 1:]
words = open(view_file).read().split()
flags = list(zip(words[::2], words[1::2]))


def numbers(text):
    return [float(x) for x in text.split(",")]


view = {name: numbers(value) for name, value in flags if name != "--light"}
bpy.ops.object.select_all(action="SELECT")
bpy.ops.object.delete()
bpy.ops.wm.obj_import(filepath=model, forward_axis="Y", up_axis="Z")

position, look_at = Vector(view["--camera"]), Vector(view["--look-at"])
sight = (look_at - position).normalized()
right = sight.cross(Vector(view["--up"])).normalized()
up = right.cross(sight)
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.data.angle = math.radians(view["--field-angle"][0])
camera.matrix_world = Matrix.Translation(position) @ Matrix((right, up, -sight)).transposed().to_4x4()
bpy.context.collection.objects.link(camera)

for name, value in flags:
    if name != "--light":
        continue
    x, y, z, r, g, b = numbers(value)
    light = bpy.data.objects.new("light", bpy.data.lights.new("light", "POINT"))
    light.location = (x, y, z)
    light.data.shadow_soft_size = 0
    light.data.color = (r, g, b)
    light.data.energy = 4 * math.pi**2 * (Vector((x, y, z)) - look_at).length_squared
    bpy.context.collection.objects.link(light)

scene = bpy.context.scene
scene.camera = camera
scene.world = None
scene.render.engine = "CYCLES"
scene.cycles.samples = 1
scene.cycles.use_denoising = False
scene.cycles.max_bounces = 0
scene.render.threads_mode = "FIXED"
scene.render.threads = 2
scene.render.resolution_x = scene.render.resolution_y = 1024
scene.render.resolution_percentage = 100
scene.view_settings.view_transform = "Standard"
scene.render.image_settings.file_format = "PNG"
scene.render.filepath = picture
bpy.ops.render.render(write_still=True)
