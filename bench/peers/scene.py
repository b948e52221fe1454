"""A scene file of ours as other renderers need it: a camera, spheres with their materials, point lights.

Coordinates stay left-handed with y up; who writes for a right-handed renderer turns them.
"""
import json
import math


def unit(v):
    return [c / math.hypot(*v) for c in v]


def cross(a, b):
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def read(path):
    """The scene of `path`. A sphere: centre, radius, material (the file's entry), emission (radiance, mostly black)."""
    with open(path, encoding="utf-8") as file:
        root = json.load(file)
    entries = {kind: {entry["id"]: entry for entry in root.get(kind, [])}
               for kind in ("cameras", "materials", "shapes", "lights")}
    composition, spheres = root["scene"], {}
    for primitive in composition["primitives"]:
        shape = entries["shapes"][primitive["shape"]]
        emission = entries["lights"][primitive["light"]]["power"] if primitive["type"] == "emissive" else [0, 0, 0]
        # A sphere listed twice is one, the first.
        spheres.setdefault((*shape["centre"], shape["radius"]), {
            "centre": shape["centre"], "radius": shape["radius"],
            "material": entries["materials"][primitive["material"]], "emission": emission})
    camera = entries["cameras"][composition["camera"]]
    if camera["type"] != "pinhole" or camera["aspect"] != 1:
        raise ValueError("only square pictures through a pinhole have a translation")
    ahead = unit([t - p for t, p in zip(camera["target"], camera["position"])])
    right = unit(cross([0, 1, 0], ahead))
    return {"camera": {"position": camera["position"], "right": right, "up": cross(ahead, right), "ahead": ahead,
                       "fov": camera["fov"]},
            "spheres": list(spheres.values()),
            "lamps": [light for light in map(entries["lights"].get, composition.get("lights", []))
                      if light["type"] == "point"],
            "background": composition.get("background", [0, 0, 0]), "depth": composition["renderer"]["depth"]}
