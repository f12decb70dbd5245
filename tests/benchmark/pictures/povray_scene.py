#!/usr/bin/python3
"""The scene of an animation.glb, at one of its keyframes, as a scene of POV-Ray with radiosity.

    povray_scene.py ANIMATION.glb TIME DISTANCE LOOK [OBSTACLE...] > SCENE.pov

A picture of it shows what carom's approximates: the same camera, bodies, surfaces, key light and backdrop, with light
that is passed on from surface to surface. Balls, boxes and cylinders are exact, and planes are endless. Colours are
linear, and half as bright as they are, so that 16 bits hold what is brighter than white: see look.py. Light from behind,
outlines and what is flat by choice are carom's alone. A flat part of something is a plane, unless it is a part of one of
the obstacles that are named.
"""

import json
import math
import os
import re
import struct
import sys

LOOKS = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../../src/scene/look')
# As in src/render/lighting.h.
SOFTNESS = 0.03  # tangent of half the angle of the key light
USUAL = math.pi * 683  # lux of a light of intensity 1
EXPOSURE = 0.5


def add(a, b):
    return [x + y for x, y in zip(a, b)]


def scaled(s, a):
    return [s * x for x in a]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    return scaled(1 / math.hypot(*a), a)


def text(a):
    return '<' + ', '.join(f'{x:.9g}' for x in a) + '>'


def rgb(a):
    return 'rgb ' + text(a)


def fresnel(cosine):
    """The part of the light that a surface with a refractive index of 1.5 mirrors."""
    g = math.sqrt(1.5**2 - 1 + cosine**2)
    a, b = (g - cosine) / (g + cosine), (cosine * (g + cosine) - 1) / (cosine * (g - cosine) + 1)
    return 0.5 * a**2 * (1 + b**2)


def linear(srgb):
    """Of 0xrrggbb."""
    parts = [(srgb >> shift & 255) / 255 for shift in (16, 8, 0)]
    return [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055)**2.4 for c in parts]


def look_of(name):
    """The fields of a look that lights a scene, from the table of carom's looks."""
    with open(LOOKS + '.h', encoding='utf-8') as file:
        names = re.search(r'look_names = "([^"]+)"', file.read())[1].split('|')
    with open(LOOKS + '.cpp', encoding='utf-8') as file:
        table = file.read().split('.bodies')[1 + names.index(name)]
    colors = {key: linear(int(value, 16)) for key, value in re.findall(r'\.(\w+) = (0x[0-9a-f]{6})\b', table)}
    numbers = {key: float(value) for key, value in re.findall(r'\.(\w+) = ([0-9.]+),', table)}
    squares = 'FloorPattern::squares' in table
    return {**colors, **numbers, 'seamless': '.seamless = true' in table, 'squares': squares}


def turned(q, v):
    """v, turned by the quaternion q."""
    t = scaled(2, cross(q[:3], v))
    return add(add(v, scaled(q[3], t)), cross(q[:3], t))


class Model:
    """What a file of carom's has, at one time."""

    def __init__(self, path, time):
        with open(path, 'rb') as file:
            data = file.read()
        size = struct.unpack_from('<I', data, 12)[0]
        self.json = json.loads(data[20:20 + size])
        self.binary = data[28 + size:]
        nodes = self.json['nodes']
        # The root has children, and nothing else.
        self.nodes = [dict(node) for node in nodes if 'children' not in node]
        moved = {id(old): new for old, new in zip([n for n in nodes if 'children' not in n], self.nodes)}
        for animation in self.json.get('animations', []):
            for channel in animation['channels']:
                sampler = animation['samplers'][channel['sampler']]
                times = [row[0] for row in self.rows(sampler['input'])]
                values = self.rows(sampler['output'])
                path = channel['target']['path']
                if path == 'translation':
                    key = min(range(len(times)), key=lambda i: abs(times[i] - time))
                    if abs(times[key] - time) > 1e-4:
                        sys.exit(f'povray_scene: no keyframe at {time} s')
                else:
                    key = max((i for i in range(len(times)) if times[i] <= time + 1e-4), default=0)
                moved[id(nodes[channel['target']['node']])][path] = values[key]

    def rows(self, number):
        accessor = self.json['accessors'][number]
        view = self.json['bufferViews'][accessor['bufferView']]
        count = {'SCALAR': 1, 'VEC2': 2, 'VEC3': 3, 'VEC4': 4}[accessor['type']]
        letter, size = {5121: ('B', 1), 5123: ('H', 2), 5125: ('I', 4), 5126: ('f', 4)}[accessor['componentType']]
        start = view.get('byteOffset', 0) + accessor.get('byteOffset', 0)
        step = view.get('byteStride', 0) or count * size
        return [struct.unpack_from(f'<{count}{letter}', self.binary, start + i * step) for i in range(accessor['count'])]

    def mesh(self, node):
        """Name, material, places, normals, triangles."""
        mesh = self.json['meshes'][node['mesh']]
        part = mesh['primitives'][0]
        numbers = [row[0] for row in self.rows(part['indices'])]
        return (mesh['name'], self.json['materials'][part['material']], self.rows(part['attributes']['POSITION']),
                self.rows(part['attributes']['NORMAL']), [numbers[i:i + 3] for i in range(0, len(numbers), 3)])


class Picture:
    """Lines of a scene of POV-Ray."""

    def __init__(self, model, style, obstacles):
        self.model = model
        self.obstacles = obstacles  # names
        self.style = style
        self.planes = []  # point, normal, colour, opacity
        self.places, self.reaches = [], []  # of the bodies, m
        self.meshes = {}
        self.looks = set()
        self.lines = []
        eye = next(node for node in model.nodes if 'camera' in node)
        self.lens = model.json['cameras'][eye['camera']]['perspective']
        self.eye = eye['translation']
        turn = eye.get('rotation', [0, 0, 0, 1])
        self.right, self.up, back = (turned(turn, axis) for axis in ([1, 0, 0], [0, 1, 0], [0, 0, 1]))
        self.ahead = scaled(-1, back)

    def scene(self, target_distance):
        for node in self.model.nodes:
            if 'mesh' in node:
                self.add_thing(node)
        if target_distance == 0:
            target_distance = sum(math.dist(p, self.eye) for p in self.places) / max(len(self.places), 1)
        self.end_backdrop_as_the_floor_does()
        self.add_planes(target_distance)
        for node in self.model.nodes:
            if 'extensions' in node:
                self.add_light(node, target_distance)
        return self.head() + self.lines

    def head(self):
        tall = 2 * math.tan(self.lens['yfov'] / 2)
        sky = ''.join(f'    [{0.5 + 0.5 * s * u:.4f} {rgb(scaled(EXPOSURE, self.sky(s, u)))}]\n'
                      for s, u in [(-1, 1 - i / 16) for i in range(16)] + [(1, i / 16) for i in range(17)])
        return ['#version 3.7;',
                'global_settings {', '  assumed_gamma 1', '  max_trace_level 6',
                '  radiosity { pretrace_start 0.08 pretrace_end 0.01 count 120 nearest_count 8 error_bound 0.5',
                '    recursion_limit 2 low_error_factor 0.6 gray_threshold 0 minimum_reuse 0.012 brightness 1 }', '}',
                'camera {', '  perspective',
                f'  location {text(self.eye)} direction {text(self.ahead)}',
                f'  right {text(scaled(tall * self.lens["aspectRatio"], self.right))} up {text(scaled(tall, self.up))}', '}',
                # The sky that is seen, and the one that lights: carom's ambient light is a colour of its own.
                '#declare Bare = finish { ambient 0 diffuse 0 emission 1 }',
                'sphere { 0, 1 hollow no_shadow no_radiosity',
                f'  pigment {{ gradient y color_map {{\n{sky}  }} translate -0.5 * y scale 2 }}',
                f'  finish {{ Bare }} scale 1e5 translate {text(self.eye)} }}',
                'sphere { 0, 1 hollow no_shadow no_image no_reflection',
                f'  pigment {{ {rgb(scaled(EXPOSURE, self.style["ambient"]))} }} finish {{ Bare }} scale 9e4 translate {text(self.eye)} }}',
                '#declare Matt = finish { ambient 0 diffuse 1 }',
                '#declare Glossy = finish { ambient 0 diffuse 1 specular 0.35 roughness 1 / 64',
                '  reflection { 0, 1 fresnel on } conserve_energy }',
                # It takes part in no radiosity, and is lit from all sides: a funnel of glass would take hours.
                f'#declare Clear = finish {{ ambient 0 diffuse 0 emission {rgb(self.mean_light())} specular 1 roughness 1 / 64',
                '  reflection { 0.04, 1 falloff 5 } }',
                '#declare Metal = finish { ambient 0 diffuse 0.15 specular 0.9 roughness 1 / 64 metallic',
                '  reflection { 0.85 metallic } }']

    def mean_light(self):
        """Of the surroundings, and half of the key light."""
        key = scaled(0.5 * self.style['key_strength'], self.style['key'])
        return scaled(EXPOSURE, add(self.style['ambient'], key))

    def sky(self, side, up):
        t = min(max(up / 0.75, 0), 1)
        share = t * t * (3 - 2 * t)
        return add(scaled(1 - share, self.style['horizon']), scaled(share, self.style['above' if side > 0 else 'below']))

    def end_backdrop_as_the_floor_does(self):
        """As in src/render/surfaces.cpp."""
        if not self.style['seamless'] or len(self.planes) != 1:
            return
        _, normal, color, _ = self.planes[0]
        light = self.style['ambient']
        for node in self.model.nodes:
            if 'extensions' in node and (lamp := self.lamp(node))['type'] == 'directional':
                towards = turned(node.get('rotation', [0, 0, 0, 1]), [0, 0, 1])
                light = add(light, scaled(max(dot(normal, towards), 0) * lamp['intensity'] / USUAL, lamp['color']))
        self.style['horizon'] = [(1 - self.spot()) * c * x for c, x in zip(color, light)]

    def lamp(self, node):
        lights = self.model.json['extensions']['KHR_lights_punctual']['lights']
        return lights[node['extensions']['KHR_lights_punctual']['light']]

    def spot(self):
        """What a floor loses of its light far away: only in the light that a scene has by default."""
        return self.style['spot'] if self.by_default() else 0

    def by_default(self):
        lamps = [node for node in self.model.nodes if 'extensions' in node]
        return len(lamps) == 1 and self.lamp(lamps[0])['type'] == 'directional' and \
            all(abs(a - b * self.style['key_strength']) < 1e-3
                for a, b in zip(self.lamp(lamps[0])['color'], self.style['key']))

    def add_thing(self, node):
        name, material, places, normals, triangles = self.model.mesh(node)
        color = material['pbrMetallicRoughness']['baseColorFactor'][:3]
        at, size = list(node.get('translation', [0, 0, 0])), list(node.get('scale', [1, 1, 1]))
        look = self.look(material)
        kind = name.split(' ')[0] if ' ' in name else 'still'
        if kind != 'still':
            self.places.append(at)
        if max(size) == 0:
            return
        is_flat = kind == 'still' and all(n == normals[0] for n in normals) and not material.get('doubleSided')
        if is_flat and node['name'].rpartition('.')[0] in self.obstacles:
            # A flat part of a hollow obstacle is seen from within alone.
            if dot(normals[0], add(self.eye, scaled(-1, at))) <= dot(normals[0], places[0]):
                return
        elif is_flat:
            opacity = material['pbrMetallicRoughness']['baseColorFactor'][3]
            self.planes.append((add(at, places[0]), list(normals[0]), color, opacity))
            return
        if kind == 'ball':
            self.reaches.append(size[0])
            self.lines.append(f'sphere {{ {text(at)}, {size[0]:.9g} {look} }}')
        elif kind == 'box':
            self.reaches.append(math.hypot(*size))
            self.lines.append(f'box {{ {text(add(at, scaled(-1, size)))}, {text(add(at, size))} {look} }}')
        elif kind == 'cylinder':
            self.reaches.append(math.hypot(*size[:2]))
            ends = [text(add(at, [0, s * size[1], 0])) for s in (-1, 1)]
            self.lines.append(f'cylinder {{ {ends[0]}, {ends[1]}, {size[0]:.9g} {look} }}')
        else:
            if kind == 'mesh':
                self.reaches.append(max(math.hypot(*p) for p in places))
            self.lines.append(f'object {{ {self.mesh_name(node["mesh"], places, normals, triangles)} scale {text(size)} '
                              f'translate {text(at)} {look} }}')

    def look(self, material):
        """The name of the texture of a surface: what the surface mirrors does not reach its matt part."""
        *color, opacity = material['pbrMetallicRoughness']['baseColorFactor']
        metal, glows = material['pbrMetallicRoughness']['metallicFactor'] == 1, 'emissiveFactor' in material
        name = 'Look' + '_'.join(f'{round(1e6 * c)}' for c in (*color, opacity, metal, glows))
        if name not in self.looks:
            self.looks.add(name)
            # The pattern aoi is 1 - angle / pi.
            angles = [math.pi / 2 * (1 - i / 16) for i in range(17)]
            rows = ''.join(f'[{1 - a / math.pi:.6f} rgbt <{", ".join(f"{x:.9g}" for x in seen)}, {1 - opacity:.6g}>]'
                           for a in angles for seen in [scaled(1.04 - fresnel(math.cos(a)), color)])
            pigment = f'pigment {{ {rgb(color)} }}' if metal else f'pigment {{ aoi color_map {{ {rows} }} }}'
            # Light is not refracted, as in carom, whose walls are thin.
            finish = 'Metal' if metal else 'Glossy emission 0.5' if glows else 'Clear' if opacity < 1 else 'Glossy'
            self.lines.append(f'#declare {name} = texture {{ {pigment} finish {{ {finish} }} }}')
        if opacity < 1:
            return f'texture {{ {name} }} no_radiosity'
        return f'texture {{ {name} }}' + ('' if metal else ' interior { ior 1.5 }')

    def mesh_name(self, number, places, normals, triangles):
        if number not in self.meshes:
            self.meshes[number] = f'Mesh{number}'
            rows = [', '.join(text(row) for row in rows) for rows in (places, normals, triangles)]
            self.lines.append(f'#declare Mesh{number} = mesh2 {{\n  vertex_vectors {{ {len(places)}, {rows[0]} }}\n'
                              f'  normal_vectors {{ {len(normals)}, {rows[1]} }}\n'
                              f'  face_indices {{ {len(triangles)}, {rows[2]} }} }}')
        return self.meshes[number]

    def square(self, distance):
        """The side of the squares, as in src/render/surfaces.cpp."""
        width = 2 * distance * math.tan(self.lens['yfov'] / 2) * self.lens['aspectRatio']
        middle = sorted(self.reaches)[len(self.reaches) // 2] if self.reaches else 0
        wanted = min(max(8 * middle, width / 12), width / 2)
        power = 10 ** math.floor(math.log10(wanted))
        return next(digit * power for digit in (5, 2, 1) if digit * power <= wanted * (1 + 1e-12))

    def add_planes(self, distance):
        side = self.square(distance)
        middle = scaled(1 / max(len(self.places), 1), [sum(p[k] for p in self.places) for k in range(3)])
        reach = 0.6 * max([distance, *(math.dist(p, self.eye) for p in self.places)])
        for i, (point, normal, color, opacity) in enumerate(self.planes):
            height = dot(normal, point)
            # carom shows planes from their free side alone, and they take no light from other things.
            if dot(normal, self.eye) <= height:
                continue
            along = [0, 1, 0] if abs(normal[1]) < 0.999 else [0, 0, -1]
            right = unit(cross(along, normal))
            up = cross(normal, right)
            rows = ', '.join(f'{x:.9g}' for x in [*right, *normal, *up, *scaled(height, normal)])
            others = ' '.join(f'plane {{ {text(scaled(-1, n))}, {-dot(n, p) + 1e-9:.9g} }}'
                              for k, (p, n, *_) in enumerate(self.planes) if k != i)
            cut = f'clipped_by {{ intersection {{ {others} }} }}' if others.count('plane') > 1 else \
                  f'clipped_by {{ {others} }}' if others else ''
            dark, seen = 1 - self.style.get('contrast', 0), f'rgbt <%s, {1 - opacity:.6g}>'
            shown = [seen % ', '.join(f'{x:.9g}' for x in scaled(share, color)) for share in (dark, 1, 1 - self.spot())]
            if self.style['squares']:
                pigment = f'checker {shown[0]}, {shown[1]} translate 0.5 * y scale {side:.9g} matrix <{rows}>'
            else:
                # As in src/raster/ground.inc.
                pigment = f'function {{ 1 / (1 + x * x + y * y + z * z) }} color_map {{ [0 {shown[2]}] [1 {shown[1]}] }}' \
                          f' scale {reach:.9g} translate {text(middle)}'
            self.lines.append(f'plane {{ {text(normal)}, {height:.9g} no_shadow {cut} finish {{ Matt }}\n'
                              f'  pigment {{ {pigment} }} }}')

    def add_light(self, node, distance):
        light = self.lamp(node)
        if light['type'] == 'directional':
            towards = turned(node.get('rotation', [0, 0, 0, 1]), [0, 0, 1])
            at, radiance = add(self.eye, scaled(1e4 * distance, towards)), light['intensity'] / USUAL
            away = 1e4 * distance
        else:
            at = node['translation']
            target = add(self.eye, scaled(distance, self.ahead))
            towards = unit(add(at, scaled(-1, target)))
            away = math.dist(at, target)
            radiance = light['intensity'] / USUAL / away**2
        right = unit(cross([0, 1, 0] if abs(towards[1]) < 0.9 else [1, 0, 0], towards))
        side = 2 * SOFTNESS * away
        self.lines.append(f'light_source {{ {text(at)}, {rgb(scaled(EXPOSURE * radiance, light["color"]))}\n'
                          f'  area_light {text(scaled(side, right))}, {text(scaled(side, cross(towards, right)))}, 9, 9'
                          ' adaptive 2 jitter circular orient }')


def main():
    if len(sys.argv) < 5:
        sys.exit('usage: povray_scene.py ANIMATION.glb TIME DISTANCE LOOK [OBSTACLE...]; the distance is that of the camera from its target;'
                 ' 0: from the bodies')
    model = Model(sys.argv[1], float(sys.argv[2]))
    print('\n'.join(Picture(model, look_of(sys.argv[4]), sys.argv[5:]).scene(float(sys.argv[3]))))


if __name__ == '__main__':
    main()
