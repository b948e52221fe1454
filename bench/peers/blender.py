"""Within Blender: blender --background --factory-startup --threads 1 --python blender.py -- JOB

JOB is a JSON file: `scene` (as scene.py makes it), `lamps` (mesh or point), `size`, `renders` (a list of samples, seed,
file). Renders each to an EXR of 32-bit floats and leaves the processor seconds that took in FILE.time.
"""
import json
import math
import sys
import time

import bpy
from mathutils import Matrix, Vector


def turned(v):
    """Ours is left-handed with y up, Blender right-handed with z up: y and z change places."""
    return Vector((v[0], v[2], v[1]))


def place(thing, matrix):
    placed = bpy.data.objects.new("", thing)
    placed.matrix_world = matrix
    bpy.context.collection.objects.link(placed)
    return placed


def material_of(sphere):
    material, ours = bpy.data.materials.new(""), sphere["material"]
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    kinds = {"diffuse": "Diffuse", "specular reflection": "Glossy", "glossy reflection": "Glossy",
             "fresnel dielectric": "Glass"}
    surface = nodes.new("ShaderNodeBsdf" + kinds[ours["type"]])
    surface.inputs["Color"].default_value = (*ours.get("rho", ours.get("rhoR")), 1)
    if ours.get("rhoR") != ours.get("rhoT"):
        raise ValueError("Blender's glass has one colour")
    if kinds[ours["type"]] != "Diffuse":
        # A microfacet tilted by t turns the mirrored ray by 2t. Our lobe's mean squared angle is 2/3 roughness^2, that
        # of Beckmann's distribution 4 alpha^2, and Blender's roughness is the root of alpha.
        roughness = ours.get("roughness", 0)
        surface.distribution = "BECKMANN" if roughness else "SHARP"
        surface.inputs["Roughness"].default_value = math.sqrt(roughness / math.sqrt(6))
    if "eta" in ours:
        surface.inputs["IOR"].default_value = ours["eta"]
    if any(sphere["emission"]):
        emission, both = nodes.new("ShaderNodeEmission"), nodes.new("ShaderNodeAddShader")
        emission.inputs["Color"].default_value = (*sphere["emission"], 1)
        links.new(emission.outputs[0], both.inputs[0])
        links.new(surface.outputs[0], both.inputs[1])
        surface = both
    links.new(surface.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return material


def add_mesh(sphere, towards):
    """A smooth-shaded mesh whose pole points `towards` the camera; a wall's rings crowd there."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=64)
    bpy.ops.object.shade_smooth()
    crowding = 6 if sphere["radius"] > 50 else 1e-3
    for vertex in bpy.context.object.data.vertices:
        angle = math.acos(max(-1, min(1, vertex.co.z)))
        angle = math.pi * math.sinh(crowding * angle / math.pi) / math.sinh(crowding)
        vertex.co = (*(vertex.co.xy.normalized() * math.sin(angle)), math.cos(angle))
    bpy.context.object.data.materials.append(material_of(sphere))
    centre = turned(sphere["centre"])
    bpy.context.object.matrix_world = Matrix.LocRotScale(
        centre, (towards - centre).to_track_quat("Z", "Y"), Vector([sphere["radius"]] * 3))


def add_lamp(position, radius, intensity):
    """Blender's point lamp, whose watts are 4 pi times the intensity in W/sr."""
    lamp = bpy.data.lights.new("", "POINT")
    lamp.energy, lamp.color = 4 * math.pi * max(intensity), [c / max(intensity) for c in intensity]
    lamp.shadow_soft_size = radius
    place(lamp, Matrix.Translation(turned(position)))


def build(ours, lamps):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    for sphere in ours["spheres"]:
        if lamps == "point" and any(sphere["emission"]):
            # A sphere of radiance L has the intensity L times its disc.
            disc = math.pi * sphere["radius"] ** 2
            add_lamp(sphere["centre"], sphere["radius"], [disc * c for c in sphere["emission"]])
        else:
            add_mesh(sphere, turned(ours["camera"]["position"]))
    for lamp in ours["lamps"]:
        add_lamp(lamp["position"], 0, lamp["power"])
    world = bpy.context.scene.world = bpy.data.worlds.new("")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (*ours["background"], 1)
    camera = bpy.data.cameras.new("")
    camera.sensor_fit, camera.angle = "VERTICAL", math.radians(ours["camera"]["fov"])
    axes = [turned(ours["camera"]["right"]), turned(ours["camera"]["up"]), -turned(ours["camera"]["ahead"])]
    bpy.context.scene.camera = place(camera, Matrix.LocRotScale(
        turned(ours["camera"]["position"]), Matrix(axes).transposed(), None))


def configure(size, depth):
    render, cycles = bpy.context.scene.render, bpy.context.scene.cycles
    render.engine, render.threads_mode, render.threads = "CYCLES", "FIXED", 1
    render.resolution_x = render.resolution_y = size
    output = render.image_settings
    output.file_format, output.color_depth, output.color_mode = "OPEN_EXR", "32", "RGB"
    cycles.pixel_filter_type, cycles.use_adaptive_sampling, cycles.use_denoising = "BOX", False, False
    cycles.light_sampling_threshold = cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.blur_glossy, cycles.caustics_reflective, cycles.caustics_refractive = 0, True, True
    # Cycles counts the bounces before the last light sample, our depth the scattering events with it.
    for kind in ("max", "diffuse", "glossy", "transmission"):
        setattr(cycles, kind + "_bounces", depth - 1)


def main(path):
    with open(path, encoding="utf-8") as file:
        job = json.load(file)
    build(job["scene"], job["lamps"])
    configure(job["size"], job["scene"]["depth"])
    for wanted in job["renders"]:
        bpy.context.scene.cycles.samples, bpy.context.scene.cycles.seed = wanted["samples"], wanted["seed"]
        bpy.context.scene.render.filepath = wanted["file"]
        begin = time.process_time()
        bpy.ops.render.render(write_still=True)
        with open(wanted["file"] + ".time", "w", encoding="utf-8") as file:
            file.write(str(time.process_time() - begin))


if __name__ == "__main__":
    main(sys.argv[-1])
