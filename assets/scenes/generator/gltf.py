"""Writes glTF 2.0: one .gltf and one .bin a scene, byte for byte the same on every machine.

`Gltf` collects materials, textures, meshes, nodes, lights, cameras and one animation in the order they are added;
`files()` returns what to write. Units are glTF's: metres, right-handed, Y up, radians inside, degrees where a person
types them.
"""

import json
import math
import struct

from . import png
from .numbers import rounded, tidy

GENERATOR = "assets/scenes/make_scenes.py"
_FLOAT, _UINT16, _UINT32 = 5126, 5123, 5125
_ARRAY_BUFFER, _ELEMENT_ARRAY_BUFFER = 34962, 34963
_REPEAT, _CLAMP, _LINEAR, _LINEAR_MIPMAP_LINEAR = 10497, 33071, 9729, 9987


class Gltf:
    def __init__(self, name, about, copyright="The authors of Bounce; licensed as the project is"):
        self.name = name
        self.asset = {"version": "2.0", "generator": GENERATOR, "copyright": copyright, "extras": {"about": about}}
        self.binary = bytearray()
        self.views, self.accessors = [], []
        self.materials, self.textures, self.samplers, self.images = [], [], [], []
        self.meshes, self.nodes, self.cameras, self.lights = [], [], [], []
        self.channels, self.animation_samplers = [], []
        self.roots = []
        self.surfaces = []  # (Surface, its glTF primitive)
        self.extensions = set()
        self.image_files = {}  # path -> bytes

    # -- data ---------------------------------------------------------------------------------------------------------

    def _view(self, data, target=None):
        while len(self.binary) % 4:
            self.binary.append(0)
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)}
        if target:
            view["target"] = target
        self.binary += data
        self.views.append(view)
        return len(self.views) - 1

    def _floats(self, rows, kind, target=None, bounds=False):
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[kind]
        values = [rounded(component) for row in rows for component in (row if width > 1 else (row,))]
        data = struct.pack("<%df" % len(values), *values)
        accessor = {"bufferView": self._view(data, target), "componentType": _FLOAT, "count": len(rows), "type": kind}
        if bounds:
            stored = struct.unpack("<%df" % len(values), data)
            accessor["min"] = [min(stored[i::width]) for i in range(width)]
            accessor["max"] = [max(stored[i::width]) for i in range(width)]
        self.accessors.append(accessor)
        return len(self.accessors) - 1

    def _indices(self, indices, vertex_count):
        letter, component = ("H", _UINT16) if vertex_count < 65535 else ("I", _UINT32)
        data = struct.pack("<%d%s" % (len(indices), letter), *indices)
        self.accessors.append({"bufferView": self._view(data, _ELEMENT_ARRAY_BUFFER), "componentType": component,
                               "count": len(indices), "type": "SCALAR"})
        return len(self.accessors) - 1

    # -- what a scene is made of --------------------------------------------------------------------------------------

    def texture(self, path, picture, clamp=False):
        """Adds a picture (a png.Picture) under `path`, relative to the .gltf; returns the texture's index."""
        sampler = {"magFilter": _LINEAR, "minFilter": _LINEAR_MIPMAP_LINEAR,
                   "wrapS": _CLAMP if clamp else _REPEAT, "wrapT": _CLAMP if clamp else _REPEAT}
        if sampler not in self.samplers:
            self.samplers.append(sampler)
        self.image_files[path] = png.encode(picture)
        self.images.append({"uri": path})
        self.textures.append({"sampler": self.samplers.index(sampler), "source": len(self.images) - 1})
        return len(self.textures) - 1

    def material(self, name, colour=(1, 1, 1), metallic=0.0, roughness=1.0, colour_texture=None, surface_texture=None,
                 normal_texture=None, normal_scale=1.0, emission=None, emission_texture=None, alpha_cutoff=None,
                 double_sided=False):
        """Adds a metallic-roughness material; `emission` is a radiance in W/(sr m2) and may exceed 1."""
        surface = {"baseColorFactor": [*colour, 1.0], "metallicFactor": metallic, "roughnessFactor": roughness}
        if colour_texture is not None:
            surface["baseColorTexture"] = {"index": colour_texture}
        if surface_texture is not None:
            surface["metallicRoughnessTexture"] = {"index": surface_texture}
        material = {"name": name, "pbrMetallicRoughness": surface}
        if normal_texture is not None:
            material["normalTexture"] = {"index": normal_texture, "scale": normal_scale}
        if emission is not None:
            strength = max(emission)
            material["emissiveFactor"] = [component / strength for component in emission]
            if strength != 1:
                material["extensions"] = {"KHR_materials_emissive_strength": {"emissiveStrength": strength}}
                self.extensions.add("KHR_materials_emissive_strength")
        if emission_texture is not None:
            material["emissiveTexture"] = {"index": emission_texture}
        if alpha_cutoff is not None:
            material["alphaMode"] = "MASK"
            material["alphaCutoff"] = alpha_cutoff
        if double_sided:
            material["doubleSided"] = True
        self.materials.append(material)
        return len(self.materials) - 1

    def mesh(self, name, parts):
        """Adds a mesh of (Surface, material index) parts; returns its index. A surface used again is stored once."""
        self.meshes.append({"name": name, "primitives": [dict(self._stored(surface), material=material)
                                                         for surface, material in parts]})
        return len(self.meshes) - 1

    def _stored(self, surface):
        for known, primitive in self.surfaces:
            if known is surface:
                return primitive
        attributes = {"POSITION": self._floats(surface.positions, "VEC3", _ARRAY_BUFFER, bounds=True),
                      "NORMAL": self._floats(surface.normals, "VEC3", _ARRAY_BUFFER)}
        if surface.has_uv:
            attributes["TEXCOORD_0"] = self._floats(surface.uvs, "VEC2", _ARRAY_BUFFER)
        primitive = {"attributes": attributes, "indices": self._indices(surface.indices, len(surface.positions))}
        self.surfaces.append((surface, primitive))
        return primitive

    def node(self, name, mesh=None, translation=None, rotation=None, scale=None, parent=None, camera=None, light=None):
        node = {"name": name}
        if translation is not None:
            node["translation"] = list(translation)
        if rotation is not None:
            node["rotation"] = list(rotation)
        if scale is not None:
            node["scale"] = list(scale)
        if mesh is not None:
            node["mesh"] = mesh
        if camera is not None:
            node["camera"] = camera
        if light is not None:
            node["extensions"] = {"KHR_lights_punctual": {"light": light}}
        self.nodes.append(node)
        index = len(self.nodes) - 1
        if parent is None:
            self.roots.append(index)
        else:
            self.nodes[parent].setdefault("children", []).append(index)
        return index

    def camera(self, name, position, rotation, vfov_degrees, aspect):
        self.cameras.append({"name": name, "type": "perspective", "perspective": {
            "yfov": math.radians(vfov_degrees), "aspectRatio": aspect, "znear": 0.05, "zfar": 200.0}})
        return self.node(name, translation=position, rotation=rotation, camera=len(self.cameras) - 1)

    def spot(self, name, position, rotation, intensity, inner_degrees, outer_degrees, colour=(1, 1, 1)):
        """A spot light; `intensity` in W/sr, half-angles in degrees."""
        return self._light(name, position, rotation, {
            "name": name, "type": "spot", "color": list(colour), "intensity": intensity,
            "spot": {"innerConeAngle": math.radians(inner_degrees), "outerConeAngle": math.radians(outer_degrees)}})

    def directional(self, name, rotation, intensity, colour=(1, 1, 1), position=None):
        """A directional light; `intensity` in W/m2 at normal incidence."""
        return self._light(name, position, rotation, {
            "name": name, "type": "directional", "color": list(colour), "intensity": intensity})

    def _light(self, name, position, rotation, light):
        self.extensions.add("KHR_lights_punctual")
        self.lights.append(light)
        return self.node(name, translation=position, rotation=rotation, light=len(self.lights) - 1)

    def animate(self, node, path, times, values):
        """Linear keys for a node's `path` ("translation" or "rotation")."""
        self.animation_samplers.append({
            "input": self._floats(times, "SCALAR", bounds=True),
            "output": self._floats(values, "VEC4" if path == "rotation" else "VEC3"), "interpolation": "LINEAR"})
        self.channels.append({"sampler": len(self.animation_samplers) - 1, "target": {"node": node, "path": path}})

    # -- files --------------------------------------------------------------------------------------------------------

    def files(self):
        """{path relative to the scenes folder: bytes}."""
        document = {"asset": self.asset, "scene": 0, "scenes": [{"name": self.name, "nodes": self.roots}]}
        if self.extensions:
            document["extensionsUsed"] = sorted(self.extensions)
        if self.lights:
            document["extensions"] = {"KHR_lights_punctual": {"lights": self.lights}}
        if self.channels:
            document["animations"] = [{"name": self.name, "channels": self.channels,
                                       "samplers": self.animation_samplers}]
        for key, rows in (("nodes", self.nodes), ("meshes", self.meshes), ("materials", self.materials),
                          ("textures", self.textures), ("samplers", self.samplers), ("images", self.images),
                          ("cameras", self.cameras), ("accessors", self.accessors), ("bufferViews", self.views)):
            if rows:
                document[key] = rows
        document["buffers"] = [{"uri": self.name + ".bin", "byteLength": len(self.binary)}]
        result = {self.name + ".gltf": _as_json(tidy(document)), self.name + ".bin": bytes(self.binary)}
        result.update(self.image_files)
        return result


def _as_json(document):
    """One row of a list a line: short enough to commit, and a change shows up as changed lines."""
    lines = []
    keys = list(document)
    for key in keys:
        value, comma = document[key], "," if key != keys[-1] else ""
        if isinstance(value, list):
            rows = ",\n".join("  " + json.dumps(row, ensure_ascii=True) for row in value)
            lines.append(' %s: [\n%s\n ]%s' % (json.dumps(key), rows, comma))
        else:
            lines.append(' %s: %s%s' % (json.dumps(key), json.dumps(value, ensure_ascii=True), comma))
    return ("{\n" + "\n".join(lines) + "\n}\n").encode("ascii")
