#!/usr/bin/python3
"""Opens what a run wrote for other programs by VTK (python3-vtk9), ParaView's own library, and holds it against
trajectory.csv: by_vtk.py CAROM SCENE FOLDER runs the scene into the folder first.
"""
import csv
import os
import subprocess
import sys

import vtk


def read_vtp(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    assert reader.GetErrorCode() == 0
    return reader.GetOutput()


def check_points(folder, instants):
    for i, (time, rows) in enumerate(instants):
        data = read_vtp(os.path.join(folder, f'vtk/bodies_{i:05}.vtp'))
        assert data.GetFieldData().GetArray('TimeValue').GetValue(0) == time
        of_points = data.GetPointData()
        name, velocity = of_points.GetAbstractArray('name'), of_points.GetVectors()
        assert data.GetNumberOfPoints() == data.GetNumberOfVerts() == len(rows)
        for k, row in enumerate(rows):
            assert name.GetValue(k) == row['body']
            assert data.GetPoint(k) + velocity.GetTuple(k) == tuple(float(row[key]) for key in list(row)[2:])


def check_surfaces(folder):
    data = read_vtp(os.path.join(folder, 'surfaces.vtp'))
    names = data.GetCellData().GetAbstractArray('name')
    seen = {names.GetValue(i) for i in range(data.GetNumberOfPolys())}
    assert seen == {f'room.{axis}_{end}' for axis in 'xyz' for end in ('min', 'max')} | {'board', 'post', 'knob', 'block'}
    assert all(abs(a - b) < 1e-12 for a, b in zip(data.GetBounds(), (-1.5, 1.5, 0, 3.5, -1.5, 1.5)))


def blocks(data, found):
    """All surfaces of a tree of blocks, in order."""
    for i in range(data.GetNumberOfBlocks()):
        block = data.GetBlock(i)
        if block is not None and block.IsA('vtkMultiBlockDataSet'):
            blocks(block, found)
        elif block is not None:
            found.append(block)
    return found


def check_gltf(folder, instants):
    reader = vtk.vtkGLTFReader()
    reader.SetFileName(os.path.join(folder, 'animation.glb'))
    reader.SetFrameRate(20)
    reader.UpdateInformation()
    assert reader.GetNumberOfAnimations() == 1 and reader.GetAnimationName(0) == 'motion'
    reader.EnableAnimation(0)
    for time, rows in instants:
        reader.UpdateTimeStep(time)
        things = blocks(reader.GetOutput(), [])
        assert len(things) == len(rows) + 10  # and the fixed things
        for row, thing in zip(rows, things):
            low, high = thing.GetBounds()[::2], thing.GetBounds()[1::2]
            middle = [(a + b) / 2 for a, b in zip(low, high)]
            where = [float(row[key]) for key in ('x_m', 'y_m', 'z_m')]
            assert all(abs(a - b) < 1e-6 for a, b in zip(middle, where)), (row['body'], time, middle, where)


def main():
    carom, scene, folder = sys.argv[1:]
    subprocess.run([carom, 'run', scene, '-q', '--force', '-o', folder], check=True)
    instants = []
    with open(os.path.join(folder, 'trajectory.csv'), newline='') as file:
        for row in csv.DictReader(file):
            if not instants or instants[-1][0] != float(row['time_s']):
                instants.append((float(row['time_s']), []))
            instants[-1][1].append(row)
    check_points(folder, instants)
    check_surfaces(folder)
    check_gltf(folder, instants)


main()
