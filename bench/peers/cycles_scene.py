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


def model_facts():
    """The number of triangles and the box, from what was imported."""
    triangles, low, high = 0, Vector([math.inf] * 3), Vector([-math.inf] * 3)
    for thing in meshes():
        triangles += sum(len(face.vertices) - 2 for face in thing.data.polygons)
        for vertex in thing.data.vertices:
            place = thing.matrix_world @ vertex.co
            low = Vector(map(min, low, place))
            high = Vector(map(max, high, place))
    return {"triangles": triangles, "low": list(low), "high": list(high)}


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


def add_point_light(position, color):
    """A point light of no size that makes a white surface `color` bright at distance 1, straight on, and fades
    with the square of the distance.

    P watts are P / (4 pi) watts a steradian, so P / (4 pi) watts a square unit at distance 1; a white Lambert
    surface sends back 1 / pi of that: 4 pi^2 watts make it 1.
    """
    light = bpy.data.objects.new("light", bpy.data.lights.new("light", "POINT"))
    light.location = position
    light.data.shadow_soft_size = 0
    light.data.color = color
    light.data.energy = 4 * math.pi**2
    bpy.context.collection.objects.link(light)
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


def diffuse_only():
    """Makes each Principled material a Lambert surface of the colour and texture that the importer found."""
    for material in bpy.data.materials:
        tree = material.node_tree
        shader = next((n for n in tree.nodes if n.type == "BSDF_PRINCIPLED"), None) if material.use_nodes else None
        if shader is None:
            continue
        surface = tree.nodes.new("ShaderNodeBsdfDiffuse")
        give_color(tree, shader.inputs["Base Color"], surface.inputs["Color"])
        output = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL")
        tree.links.new(surface.outputs["BSDF"], output.inputs["Surface"])


def lambert():
    """Diffuse surfaces (of glTF's specular and glossiness) obey Lambert's law, not Oren's and Nayar's."""
    for material in bpy.data.materials:
        for shader in [n for n in material.node_tree.nodes if n.type == "BSDF_DIFFUSE"] if material.use_nodes else []:
            shader.inputs["Roughness"].default_value = 0


def give_color(tree, source, target):
    """Links what is linked to `source`, times the constant that stands there: MTL's map_Kd multiplies Kd."""
    target.default_value = source.default_value
    if not source.is_linked:
        return
    product = tree.nodes.new("ShaderNodeMixRGB")
    product.blend_type = "MULTIPLY"
    product.inputs["Fac"].default_value = 1
    tree.links.new(source.links[0].from_socket, product.inputs["Color1"])
    constant = source.default_value
    product.inputs["Color2"].default_value = constant if any(constant[:3]) else (1, 1, 1, 1)
    tree.links.new(product.outputs["Color"], target)
