# SPDX-License-Identifier: MIT
# Renders an OBJ in Blender's Cycles at 1, 2, 4 ... samples a pixel until a picture takes SECONDS, set up as Boxwood's path tracer
# is: paths of as many segments, a box filter one pixel wide, nothing clamped, nothing denoised, the same samples for every pixel.
#   blender -b --factory-startup --python cycles_ladder.py -- MODEL.obj VIEW.json WIDTH HEIGHT FOLDER SEED SECONDS
# Writes FOLDER/SAMPLES.exr, linear, and prints 'LADDER {"samples": N, "seconds": S}' for each; set-up counts in S.
import json
import math
import os
import sys
import time

import bpy
from mathutils import Matrix, Vector

BOUNCES = 8  # as Boxwood's default counts them: scatterings; Cycles counts what follows the first


def read_materials(path):
    """{name: {key: [numbers]}} of an MTL file."""
    materials, current = {}, None
    with open(path, encoding="utf-8") as lines:
        for words in map(str.split, lines):
            if words and words[0] == "newmtl":
                current = materials.setdefault(words[1], {})
            elif words and current is not None:
                try:
                    current[words[0]] = [float(word) for word in words[1:]]
                except ValueError:
                    pass
    return materials


def shade(material, values):
    """Diffuse, a light, or a metal: what the compared scenes are made of."""
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    emission = values.get("Ke", [0, 0, 0])
    color = values.get("Kd", [0.8, 0.8, 0.8]) + [1]
    if max(emission) > 0:
        shader = tree.nodes.new("ShaderNodeEmission")
        shader.inputs["Color"].default_value = [part / max(emission) for part in emission] + [1]
        shader.inputs["Strength"].default_value = max(emission)
    elif values.get("Pm", [0])[0] > 0:
        shader = tree.nodes.new("ShaderNodeBsdfPrincipled")
        shader.distribution = "MULTI_GGX"
        shader.inputs["Base Color"].default_value = color
        shader.inputs["Metallic"].default_value = values["Pm"][0]
        shader.inputs["Roughness"].default_value = values["Pr"][0]
    else:
        shader = tree.nodes.new("ShaderNodeBsdfDiffuse")
        shader.inputs["Color"].default_value = color
        shader.inputs["Roughness"].default_value = 0
    tree.links.new(shader.outputs[0], output.inputs["Surface"])


def load(model):
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing, do_unlink=True)
    bpy.ops.wm.obj_import(filepath=model, forward_axis="Y", up_axis="Z")
    values = read_materials(os.path.splitext(model)[0] + ".mtl")
    for material in bpy.data.materials:
        if material.name in values:
            shade(material, values[material.name])
    for thing in bpy.data.objects:
        thing.data.polygons.foreach_set("use_smooth", [False] * len(thing.data.polygons))
        thing.data.update()


def look(scene, view):
    camera = bpy.data.cameras.new("camera")
    place = bpy.data.objects.new("camera", camera)
    scene.collection.objects.link(place)
    scene.camera = place
    camera.sensor_fit = "VERTICAL"
    camera.angle_y = math.radians(view["fov"])
    camera.clip_start, camera.clip_end = 1e-3, 1e4
    eye = Vector(view["eye"])
    back = (eye - Vector(view["target"])).normalized()
    right = Vector(view["up"]).cross(back).normalized()
    up = back.cross(right)
    place.matrix_world = Matrix([(right[i], up[i], back[i], eye[i]) for i in range(3)] + [(0, 0, 0, 1)])
    world = bpy.data.worlds.new("sky")
    scene.world = world
    world.use_nodes = True
    sky = world.node_tree.nodes["Background"]
    sky.inputs["Color"].default_value = view["sky"] + [1]
    sky.inputs["Strength"].default_value = 1


def set_up(scene, size, seed):
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y = size
    render.resolution_percentage = 100
    render.use_compositing = render.use_sequencer = render.film_transparent = False
    render.dither_intensity = 0
    scene.view_settings.view_transform = "Raw"
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth = "32"
    render.image_settings.color_mode = "RGB"
    cycles.device = "CPU"
    cycles.use_denoising = cycles.use_adaptive_sampling = cycles.use_fast_gi = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.max_bounces = cycles.diffuse_bounces = BOUNCES - 1
    cycles.glossy_bounces = cycles.transmission_bounces = BOUNCES - 1
    cycles.volume_bounces = 0
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 1
    cycles.seed = seed


def main():
    model, view_path, width, height, folder, seed, longest = sys.argv[sys.argv.index("--") + 1:]
    with open(view_path, encoding="utf-8") as file:
        view = json.load(file)
    scene = bpy.context.scene
    load(model)
    look(scene, view)
    set_up(scene, (int(width), int(height)), int(seed))
    samples, seconds = 1, 0
    while seconds < float(longest):
        scene.cycles.samples = samples
        scene.render.filepath = os.path.join(folder, f"{samples}.exr")
        start = time.perf_counter()
        bpy.ops.render.render(write_still=True)
        seconds = time.perf_counter() - start
        print("LADDER", json.dumps({"samples": samples, "seconds": seconds}), flush=True)
        samples *= 2


main()
