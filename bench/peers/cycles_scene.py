# A model, a camera and lights in Blender as FaceMap has them. Imported by the scripts that run inside of Blender.
import math

import bmesh
import bpy
import numpy
from mathutils import Matrix, Vector


def import_model(path):
    """Reads a model into an empty scene and keeps the file's coordinates."""
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
    if path.endswith(".obj"):
        bpy.ops.wm.obj_import(filepath=path, forward_axis="Y", up_axis="Z")
        multiply_by_constants()
        for image in bpy.data.images:  # without map_d an image's alpha says nothing, and leaves its colours alone
            image.alpha_mode = "CHANNEL_PACKED"
    else:
        import_gltf(path)
    for material in bpy.data.materials:
        if material.use_nodes:
            light_nothing(material)


def light_nothing(material):
    """What glows is seen, and gives no light to others."""
    material.cycles.sample_as_light = False
    tree = material.node_tree
    for shader in [node for node in tree.nodes if node.type in ("BSDF_PRINCIPLED", "EMISSION")]:
        strength = shader.inputs["Emission Strength" if shader.type == "BSDF_PRINCIPLED" else "Strength"]
        product = tree.nodes.new("ShaderNodeMath")
        product.operation = "MULTIPLY"
        product.inputs[1].default_value = strength.default_value
        tree.links.new(tree.nodes.new("ShaderNodeLightPath").outputs["Is Camera Ray"], product.inputs[0])
        tree.links.new(product.outputs[0], strength)


def import_gltf(path):
    numpy.bool = bool  # Blender 3.4's importer uses the name, NumPy 1.24 has it no more
    bpy.ops.import_scene.gltf(filepath=path)
    for extra in [o for o in bpy.data.objects if o.type in ("LIGHT", "CAMERA")]:
        bpy.data.objects.remove(extra)
    # The importer turns +y up into +z up: turned back, for cameras and lights are given in the file's axes.
    for root in [o for o in bpy.data.objects if o.parent is None]:
        root.matrix_world = Matrix.Rotation(math.radians(-90), 4, "X") @ root.matrix_world
    bpy.context.view_layer.update()


def remove_repeated_faces():
    """Leaves out faces that have the corners of an earlier one, as FaceMap does: Cycles draws dice which of them
    shadows the other."""
    known = set()
    for thing in meshes():
        places = [tuple(thing.matrix_world @ vertex.co) for vertex in thing.data.vertices]
        mesh = bmesh.new()
        mesh.from_mesh(thing.data)
        repeated = []
        for face in mesh.faces:
            corners = frozenset(places[vertex.index] for vertex in face.verts)
            if corners in known:
                repeated.append(face)
            known.add(corners)
        if repeated:
            bmesh.ops.delete(mesh, geom=repeated, context="FACES_ONLY")
            mesh.to_mesh(thing.data)
        mesh.free()


def meshes():
    return [thing for thing in bpy.data.objects if thing.type == "MESH"]


def look(position, look_at, up, field_angle, size):
    """A perspective camera; the field of view is from bottom to top, in degrees."""
    position, look_at = Vector(position), Vector(look_at)
    sight = (look_at - position).normalized()
    right = sight.cross(Vector(up)).normalized()
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "VERTICAL"
    data.angle_y = math.radians(field_angle)
    distance = (look_at - position).length
    data.clip_start, data.clip_end = distance * 1e-4, distance * 1e4
    camera = bpy.data.objects.new("camera", data)
    axes = Matrix((right, right.cross(sight), -sight)).transposed()
    camera.matrix_world = Matrix.Translation(position) @ axes.to_4x4()
    bpy.context.collection.objects.link(camera)
    scene = bpy.context.scene
    scene.camera = camera
    scene.render.resolution_x, scene.render.resolution_y = size


def add_light(kind, color):
    light = bpy.data.objects.new("light", bpy.data.lights.new("light", kind))
    light.data.color = color
    bpy.context.collection.objects.link(light)
    return light


def add_point_light(position, color, kind="POINT"):
    """A light of no size that makes a white surface `color` bright at distance 1, straight on, and fades with the
    square of the distance.

    P watts are P / (4 pi) watts a steradian, so P / (4 pi) watts a square unit at distance 1; a white Lambert
    surface sends back 1 / pi of that: 4 pi^2 watts make it 1.
    """
    light = add_light(kind, color)
    light.location = position
    light.data.shadow_soft_size = 0
    light.data.energy = 4 * math.pi**2
    return light


def point(light, direction):
    light.rotation_euler = Vector(direction).to_track_quat("-Z", "Y").to_euler()


def add_spot(position, direction, angle, color):
    """As bright within a cone of `angle` degrees, with a sharp edge: a spot's watts are those of the whole sphere."""
    light = add_point_light(position, color, "SPOT")
    light.data.spot_size, light.data.spot_blend = math.radians(angle), 0
    point(light, direction)
    return light


def add_sun(direction, color):
    """Makes a white surface `color` bright, straight on: pi watts a square unit, of which 1 / pi is sent back."""
    light = add_light("SUN", color)
    light.data.angle = 0
    light.data.energy = math.pi
    point(light, direction)
    return light


def use_cycles(threads):
    """Direct light alone, on the processor: no bounces, no world, no denoiser, no samples saved or lights left out."""
    scene = bpy.context.scene
    scene.world = None
    scene.render.engine = "CYCLES"
    scene.render.threads_mode = "FIXED"
    scene.render.threads = threads
    scene.render.resolution_percentage = 100
    scene.render.film_transparent = True
    scene.view_settings.view_transform = "Standard"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.max_bounces = 0
    cycles.use_denoising = False
    cycles.use_adaptive_sampling = False
    cycles.light_sampling_threshold = 0
    cycles.caustics_reflective = cycles.caustics_refractive = False


def sample_pixels(samples):
    """A box one pixel wide; or, for one sample, the centre of the pixel."""
    cycles = bpy.context.scene.cycles
    cycles.samples = samples
    cycles.pixel_filter_type = "GAUSSIAN" if samples == 1 else "BOX"
    cycles.filter_width = 0.01  # of the Gaussian: the least that there is


def shader_trees():
    """The nodes of each material, and which of them has the surface's colour, if that is known."""
    for material in bpy.data.materials:
        if material.use_nodes:
            shaders = [n for n in material.node_tree.nodes if n.type in ("BSDF_PRINCIPLED", "BSDF_DIFFUSE")]
            yield material.node_tree, shaders[0] if shaders else None


def put_on(tree, shader):
    """Makes a shader the one that counts."""
    output = next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL")
    tree.links.new(shader.outputs[0], output.inputs["Surface"])


def color_of(shader):
    return shader.inputs["Base Color" if shader.type == "BSDF_PRINCIPLED" else "Color"]


def diffuse_only():
    """Makes each Principled material a Lambert surface of the colour and texture that the importer found."""
    for tree, shader in shader_trees():
        if shader is not None and shader.type == "BSDF_PRINCIPLED":
            surface = tree.nodes.new("ShaderNodeBsdfDiffuse")
            copy_color(tree, color_of(shader), surface.inputs["Color"])
            if shader.inputs["Normal"].is_linked:
                tree.links.new(shader.inputs["Normal"].links[0].from_socket, surface.inputs["Normal"])
            put_on(tree, surface)


def show_colors():
    """Makes each surface glow in its own colour."""
    for tree, shader in shader_trees():
        glow = tree.nodes.new("ShaderNodeEmission")
        if shader is not None:
            copy_color(tree, color_of(shader), glow.inputs["Color"])
        put_on(tree, glow)


def show_normals():
    """Makes each surface glow by its shading normal in the world: -1 to 1 becomes 0 to 1."""
    for tree, shader in shader_trees():
        normal = tree.nodes.new("ShaderNodeNewGeometry").outputs["Normal"]
        if shader is not None and shader.inputs["Normal"].is_linked:
            normal = shader.inputs["Normal"].links[0].from_socket
        half = tree.nodes.new("ShaderNodeVectorMath")
        half.operation = "MULTIPLY_ADD"
        tree.links.new(normal, half.inputs[0])
        half.inputs[1].default_value = half.inputs[2].default_value = (0.5, 0.5, 0.5)
        glow = tree.nodes.new("ShaderNodeEmission")
        tree.links.new(half.outputs[0], glow.inputs["Color"])
        put_on(tree, glow)


def lambert():
    """Diffuse surfaces (of glTF's specular and glossiness) obey Lambert's law, not Oren's and Nayar's."""
    for tree, _ in shader_trees():
        for shader in [node for node in tree.nodes if node.type == "BSDF_DIFFUSE"]:
            shader.inputs["Roughness"].default_value = 0


def copy_color(tree, source, target):
    target.default_value = source.default_value
    if source.is_linked:
        tree.links.new(source.links[0].from_socket, target)


def multiply_by_constants():
    """MTL's map_Kd multiplies Kd, unless that is black; the importer leaves Kd beside the texture, without effect."""
    for tree, shader in shader_trees():
        color = None if shader is None else color_of(shader)
        if color is None or not color.is_linked or not any(color.default_value[:3]):
            continue
        product = tree.nodes.new("ShaderNodeMixRGB")
        product.blend_type = "MULTIPLY"
        product.inputs["Fac"].default_value = 1
        product.inputs["Color2"].default_value = color.default_value
        tree.links.new(color.links[0].from_socket, product.inputs["Color1"])
        tree.links.new(product.outputs["Color"], color)
