# Everything that is compared of one scene: blender -b --factory-startup --python cycles_pictures.py -- JOB.json
# Into the job's folder, as .npy, upper row first: color (linear), alpha, depth, lit_N for each light; ours.png as it
# is; albedo (linear) and normal.
import json
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy
import numpy

import cycles_scene

job = json.load(open(sys.argv[sys.argv.index("--") + 1]))
scene = bpy.context.scene


def render():
    """Height x width x 4 floats, linear."""
    path = os.path.join(job["folder"], "cycles.exr")
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)
    pixels = read(path)
    os.remove(path)
    return pixels


def read(path):
    """The numbers of a picture's file as they stand there; whole levels become 0 to 1."""
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Non-Color"
    width, height = image.size
    pixels = numpy.empty(width * height * 4, numpy.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return pixels.reshape(height, width, 4)[::-1]


def save(name, plane):
    numpy.save(os.path.join(job["folder"], name + ".npy"), numpy.ascontiguousarray(plane))


def material(make_shader):
    made = bpy.data.materials.new("override")
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    shader = make_shader(tree)
    tree.links.new(shader.outputs[0], tree.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return made


def white(tree):
    shader = tree.nodes.new("ShaderNodeBsdfDiffuse")
    shader.inputs["Color"].default_value = (1, 1, 1, 1)
    return shader


def distance(tree):
    """Glows as bright as the camera is far."""
    shader = tree.nodes.new("ShaderNodeEmission")
    tree.links.new(tree.nodes.new("ShaderNodeCameraData").outputs["View Distance"], shader.inputs["Strength"])
    return shader


def set_smooth(is_smooth):
    for mesh in bpy.data.meshes:
        if not is_smooth:
            mesh.use_auto_smooth = False  # the file's normals count only with it
            mesh.polygons.foreach_set("use_smooth", [False] * len(mesh.polygons))
            mesh.update()


def add_light(kind, color, place=None, direction=None, angle=None):
    if kind == "sun":
        return cycles_scene.add_sun(direction, color)
    if kind == "spot":
        return cycles_scene.add_spot(place, direction, angle, color)
    return cycles_scene.add_point_light(place, color)


def turn_on(lights, which):
    for number, light in enumerate(lights):
        light.hide_render = number != which


save("ours", read(os.path.join(job["folder"], "ours.png")))
cycles_scene.import_model(job["model"])
cycles_scene.remove_repeated_faces()
cycles_scene.look(job["camera"], job["look_at"], job["up"], job["field_angle"], job["size"])
cycles_scene.use_cycles(2)
lights = [add_light(**light) for light in job["lights"]]

# Colours: one light at a time, for Cycles draws one light at random for each sample; light adds up.
if job["model"].endswith(".obj"):
    cycles_scene.diffuse_only()
cycles_scene.lambert()
cycles_scene.sample_pixels(job["samples"])
turn_on(lights, None)
glow = render()
total = glow.copy()
for number in range(len(lights)):
    turn_on(lights, number)
    total += render() - glow
save("color", total)

# Surfaces: their own colours and their normals at the centres of pixels.
turn_on(lights, None)
cycles_scene.sample_pixels(1)
cycles_scene.show_colors()
save("albedo", render())
cycles_scene.show_normals()
save("normal", 2 * render()[:, :, :3] - 1)

# Masks: what is at the centre of each pixel, on flat faces.
set_smooth(False)
layer = bpy.context.view_layer
layer.material_override = material(distance)
shot = render()
save("alpha", shot[:, :, 3] > 0.5)
save("depth", shot[:, :, 0])
layer.material_override = material(white)
for number in range(len(lights)):
    turn_on(lights, number)
    save(f"lit_{number}", render()[:, :, :3].max(axis=2) > 0)
