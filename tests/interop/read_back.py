#!/usr/bin/python3
"""Reads what a run wrote for other programs, strictly and with nothing but Python's own library, and holds it against
trajectory.csv: read_back.py FOLDER

The folder has trajectory.csv, and what there is of trajectory.pvd, trajectory.xyz and animation.glb, all at the same
instants. Doubles must be the same to the last bit, glTF's floats the nearest. Prints a line for each that is right.
"""
import base64
import csv
import json
import os
import struct
import sys
import xml.etree.ElementTree as ElementTree


def single(value):
    return struct.unpack('<f', struct.pack('<f', value))[0]


def read_table(folder):
    """[(time, {body: (x, y, z, vx, vy, vz)})]"""
    instants = []
    with open(os.path.join(folder, 'trajectory.csv'), newline='') as file:
        for row in csv.DictReader(file):
            cells = list(row.values())
            if not instants or instants[-1][0] != float(cells[0]):
                instants.append((float(cells[0]), {}))
            instants[-1][1][cells[1]] = tuple(float(cell) for cell in cells[2:])
    return instants


def decode(array):
    """The values of a DataArray of VTK's XML files, in tuples if it has components."""
    formats = {'Float64': 'd', 'Int32': 'i', 'UInt8': 'B', 'String': 'B'}
    assert array.get('format') == 'binary'
    data = base64.b64decode(array.text, validate=True)
    size, = struct.unpack_from('<Q', data)
    assert size == len(data) - 8, 'an array has another size than it says'
    kind = formats[array.get('type')]
    values = struct.unpack(f'<{size // struct.calcsize(kind)}{kind}', data[8:])
    if array.get('type') == 'String':
        return bytes(values).decode().split('\0')[:-1]
    n = int(array.get('NumberOfComponents', '1'))
    return list(values) if n == 1 else [values[i:i + n] for i in range(0, len(values), n)]


def read_vtp(path, cells):
    root = ElementTree.parse(path).getroot()
    assert root.attrib == {'type': 'PolyData', 'version': '1.0', 'byte_order': 'LittleEndian', 'header_type': 'UInt64'}
    piece = root.find('PolyData/Piece')
    points = decode(piece.find('Points/DataArray'))
    assert len(points) == int(piece.get('NumberOfPoints'))
    data = {a.get('Name'): decode(a) for a in piece.findall('PointData/DataArray')}
    assert all(len(values) == len(points) for values in data.values())
    corners, offsets = (decode(a) for a in piece.findall(f'{cells}/DataArray'))
    assert len(offsets) == int(piece.get(f'NumberOf{cells}'))
    assert offsets == [(i + 1) * len(corners) // len(offsets) for i in range(len(offsets))]
    assert all(0 <= corner < len(points) for corner in corners)
    of_cells = {a.get('Name'): decode(a) for a in piece.findall('CellData/DataArray')}
    assert all(len(values) == len(offsets) for values in of_cells.values())
    time = root.find("PolyData/FieldData/DataArray[@Name='TimeValue']")
    return points, data, corners, of_cells, None if time is None else decode(time)[0]


def check_vtk(folder, instants):
    root = ElementTree.parse(os.path.join(folder, 'trajectory.pvd')).getroot()
    assert root.get('type') == 'Collection'
    sets = root.findall('Collection/DataSet')
    assert [float(s.get('timestep')) for s in sets] == [time for time, _ in instants]
    for entry, (time, bodies) in zip(sets, instants):
        points, data, _, _, value = read_vtp(os.path.join(folder, entry.get('file')), 'Verts')
        assert value == time
        assert data['name'] == list(bodies), 'not the bodies of trajectory.csv'
        assert [p + v for p, v in zip(points, data['velocity'])] == list(bodies.values()), f'motion differs at {time}'
        assert all(r > 0 for r in data['radius']) and all(m > 0 for m in data['mass'])
        if 'size' in data:
            for shape, size, radius in zip(data['shape'], data['size'], data['radius']):
                reach = {0: size[0] / 2, 1: (size[0]**2 + size[1]**2)**0.5 / 2, 2: sum(s * s for s in size)**0.5 / 2}
                assert abs(reach[shape] - radius) <= 1e-15 * radius
    read_vtp(os.path.join(folder, 'surfaces.vtp'), 'Polys')
    print('vtk')


def check_xyz(folder, instants):
    types = {'S': str, 'R': float, 'I': int}
    with open(os.path.join(folder, 'trajectory.xyz')) as file:
        lines = file.read().split('\n')
    assert lines.pop() == ''
    for time, bodies in instants:
        count, comment = int(lines[0]), lines[1]
        pairs = {}
        while comment:
            key, comment = comment.split('=', 1)
            value, _, comment = comment[1:].partition('" ') if comment[0] == '"' else comment.partition(' ')
            pairs[key] = value
        assert float(pairs['Time']) == time and pairs['pbc'].rstrip('"') == 'F F F'
        columns = pairs['Properties'].split(':')
        seen = {}
        for line in lines[2:2 + count]:
            cells, row = line.split(' '), {}
            for name, kind, n in zip(columns[::3], columns[1::3], columns[2::3]):
                row[name] = tuple(types[kind](cell) for cell in cells[:int(n)])
                cells = cells[int(n):]
            assert not cells, 'more cells than columns'
            seen[row['name'][0]] = row['pos'] + row['velo']
            assert row['radius'][0] > 0 and row['mass'][0] > 0 and all(0 <= c <= 1 for c in row['color'])
        assert list(seen.items()) == list(bodies.items()), f'motion differs at {time}'
        lines = lines[2 + count:]
    assert not lines, 'more frames than instants'
    print('xyz')


class Gltf:
    def __init__(self, path):
        with open(path, 'rb') as file:
            data = file.read()
        magic, version, length = struct.unpack_from('<4sII', data)
        assert (magic, version, length) == (b'glTF', 2, len(data))
        size, kind = struct.unpack_from('<I4s', data, 12)
        assert kind == b'JSON' and size % 4 == 0
        self.json = json.loads(data[20:20 + size])
        binary, kind = struct.unpack_from('<I4s', data, 20 + size)
        assert kind == b'BIN\0' and 28 + size + binary == len(data) and binary % 4 == 0
        self.binary = data[28 + size:]
        assert binary - 4 < self.json['buffers'][0]['byteLength'] <= binary

    def values(self, number):
        """The values of an accessor, in tuples; its bounds must match them."""
        accessor = self.json['accessors'][number]
        view = self.json['bufferViews'][accessor['bufferView']]
        kind = {5126: 'f', 5125: 'I', 5123: 'H', 5121: 'B'}[accessor['componentType']]
        n = {'SCALAR': 1, 'VEC3': 3}[accessor['type']]
        start = view.get('byteOffset', 0) + accessor.get('byteOffset', 0)
        assert start % struct.calcsize(kind) == 0 and view.get('byteStride') is None
        size = accessor['count'] * n * struct.calcsize(kind)
        assert accessor.get('byteOffset', 0) + size <= view['byteLength'] and start + size <= len(self.binary)
        flat = struct.unpack_from(f'<{accessor["count"] * n}{kind}', self.binary, start)
        rows = [flat[i:i + n] for i in range(0, len(flat), n)]
        if 'min' in accessor:
            assert [min(column) for column in zip(*rows)] == accessor['min']
            assert [max(column) for column in zip(*rows)] == accessor['max']
        return rows


def check_glb(folder, instants):
    gltf = Gltf(os.path.join(folder, 'animation.glb'))
    nodes = gltf.json['nodes']
    assert len({node['name'] for node in nodes}) == len(nodes)
    assert set(gltf.json.get('extensionsUsed', [])) <= {'KHR_lights_punctual'}
    for mesh in gltf.json['meshes']:
        for primitive in mesh['primitives']:
            points = gltf.values(primitive['attributes']['POSITION'])
            normals = gltf.values(primitive['attributes']['NORMAL'])
            assert len(points) == len(normals)
            assert all(abs(sum(c * c for c in normal) - 1) < 1e-5 for normal in normals)
            assert all(0 <= corner < len(points) for corner, in gltf.values(primitive['indices']))
            assert 0 <= primitive['material'] < len(gltf.json['materials'])
    animation, = gltf.json['animations']
    scales = {}
    moved = {}
    for channel in animation['channels']:
        sampler = animation['samplers'][channel['sampler']]
        name = nodes[channel['target']['node']]['name']
        times = [time for time, in gltf.values(sampler['input'])]
        values = gltf.values(sampler['output'])
        assert len(times) == len(values) and times == sorted(set(times))
        if channel['target']['path'] == 'scale':
            assert sampler['interpolation'] == 'STEP'
            scales[name] = list(zip(times, values))
        else:
            assert channel['target']['path'] == 'translation' and sampler['interpolation'] == 'LINEAR'
            assert times == [single(time) for time, _ in instants]
            moved[name] = values
    assert list(moved) == list(instants[0][1]), 'not the bodies of trajectory.csv'
    for k, (time, bodies) in enumerate(instants):
        for name, values in moved.items():
            shown = [scale for at, scale in scales.get(name, [(0, (1, 1, 1))]) if at <= single(time)][-1]
            assert (shown != (0, 0, 0)) == (name in bodies), f'wrong visibility of {name} at {time}'
            if name in bodies:
                assert values[k] == tuple(single(x) for x in bodies[name][:3]), f'wrong position of {name} at {time}'
    print('gltf')


def main():
    folder = sys.argv[1]
    instants = read_table(folder)
    for name, check in (('trajectory.pvd', check_vtk), ('trajectory.xyz', check_xyz), ('animation.glb', check_glb)):
        if os.path.exists(os.path.join(folder, name)):
            check(folder, instants)


main()
