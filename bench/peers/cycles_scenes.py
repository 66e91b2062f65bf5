"""The scenes that are compared with Cycles: file in the folder of models, camera, lights.

Colours of lights are linear. Those with a place fade with the square of the distance.
"""
SIZE = 1024
FILE_DIRECTION = [0.9245003, -0.3698001, -0.0924500]  # (0, 0, -1) turned as the node of sphere_lights.gltf has it


def light(x, y, z, distance, color=(1, 1, 1)):
    """A light that makes a white surface at `distance`, straight on, as bright as `color`."""
    return {"kind": "light", "place": [x, y, z], "color": [channel * distance**2 for channel in color]}


def spot(x, y, z, direction, angle, distance, color=(1, 1, 1)):
    """The same within a cone of `angle` degrees from side to side, with a sharp edge."""
    return dict(light(x, y, z, distance, color), kind="spot", direction=direction, angle=angle)


def sun(direction, color=(1, 1, 1)):
    return {"kind": "sun", "direction": direction, "color": color}


SCENES = {
    "hotel_room": {
        "file": "scenes/hotel_room/hotel_room.obj",
        "camera": [9200, 1500, -9800], "look_at": [11500, 500, -7000], "up": [0, 1, 0], "field_angle": 70,
        "lights": [
            light(9500, 1900, -7000, 1200),
            light(11500, 1700, -7500, 900, (1, 0.9, 0.7)),
            light(10500, 1500, -9500, 1200, (0.7, 0.8, 1)),
        ],
    },
    "typewriter_1930s": {
        "file": "scenes/typewriter_1930s/typewriter_1930s.obj",
        "camera": [0.28, 0.32, 0.48], "look_at": [0, 0.07, 0], "up": [0, 1, 0], "field_angle": 40,
        "lights": [
            light(0.5, 0.6, 0.4, 0.7),
            light(-0.6, 0.4, 0.3, 0.5, (0.7, 0.8, 1)),
            light(0.1, 0.5, -0.6, 0.5, (1, 0.8, 0.6)),
        ],
    },
    "poolTable": {
        "file": "scenes/poolTable/poolTable.obj",
        "camera": [150, 190, 170], "look_at": [0, 50, 0], "up": [0, 1, 0], "field_angle": 45,
        "lights": [
            light(0, 200, 0, 90),
            light(-150, 180, 100, 150, (0.7, 0.8, 1)),
            spot(90, 190, 40, [-1, -1.2, -0.3], 40, 150, (1, 0.8, 0.6)),
        ],
    },
    "copperBeech": {
        "file": "scenes/copperBeech/copperBeech.obj",
        "camera": [300, 330, 620], "look_at": [-10, 430, 10], "up": [0, 1, 0], "field_angle": 50,
        "lights": [
            light(-900, 500, 600, 2000, (0.7, 0.8, 1)),
            light(100, 900, -900, 2000, (1, 0.8, 0.6)),
            sun([-0.6, -0.5, -0.5], (3, 3, 3)),
        ],
    },
    "bridge_garden": {
        "file": "gltf/bridge_garden/bridge_garden.glb",
        "camera": [9, 8, 12], "look_at": [0.2, 3, 0.4], "up": [0, 1, 0], "field_angle": 45,
        "lights": [
            light(6, 11, 5, 9),
            light(-7, 7, 7, 7, (0.7, 0.8, 1)),
            light(0, 6, 0, 3, (1, 0.8, 0.6)),
        ],
    },
    "sphere_lights": {
        "file": "gltf/sphere_lights/sphere_lights.gltf",
        "camera": [1.2, 1.5, 3], "look_at": [0, 0, 0], "up": [0, 1, 0], "field_angle": 45,
        "lights": [
            light(3, 3, 2, 3),
            light(-3, 1, 3, 3, (0.7, 0.8, 1)),
            # Those of the file, from its nodes: a point and a spot in the sphere's middle, and the directional one.
            light(0, 0, 0, 5**0.5, (0.9, 0.97, 1)),
            spot(0, 0, 0, FILE_DIRECTION, 2 * 45.8366236, 3**0.5, (0.72, 0.71, 1)),
            sun(FILE_DIRECTION, (0.9, 0.9, 0.9)),
        ],
    },
}


def view_flags(scene, size=SIZE):
    """What facemap render is told of the scene. Lights come in the order of its light masks."""

    def text(*values):
        return ",".join(str(value) for value in values)

    flags = ["--projection", "plane", "--size", f"{size}x{size}", "--falloff", "inverse-square"]
    flags += ["--camera", text(*scene["camera"]), "--look-at", text(*scene["look_at"]), "--up", text(*scene["up"])]
    flags += ["--field-angle", str(scene["field_angle"])]
    for each in scene["lights"]:
        place, direction, angle = each.get("place", []), each.get("direction", []), each.get("angle")
        cone = [angle, angle] if angle else []
        flags += ["--" + each["kind"], text(*place, *direction, *cone, *each["color"])]
    return flags
