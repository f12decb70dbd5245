#!/usr/bin/python3
"""CPU milliseconds of a picture by VTK's OpenGL renderer, of the balls of a file by carom_pictures.

    vtk_pictures.py SCENE.json HOW [FILE.png]

HOW: impostors (vtkOpenGLSphereMapper) or glyphs (vtkGlyph3DMapper, spheres of 512 triangles, 4 samples a pixel), with
`_shadows` behind it for vtkShadowMapPass. The balls move before each picture. Prints the medians of drawing, with the
pixels read back, and of the PNG in memory; FILE.png receives the last picture.
"""

import json
import statistics
import sys
import time

import vtk
from vtk.util import numpy_support
import numpy

LONGEST = 40  # s of CPU time; then no further picture begins
PICTURES = 9


def ball_data(scene):
    centers, radii, colors = zip(*scene['balls'])
    data = vtk.vtkPolyData()
    points = vtk.vtkPoints()
    points.SetData(numpy_support.numpy_to_vtk(numpy.array(centers, numpy.float32), deep=True))
    data.SetPoints(points)
    for name, values in [('radius', numpy.array(radii, numpy.float32)),
                         ('color', (255 * srgb(numpy.array(colors)) + 0.5).astype(numpy.uint8))]:
        array = numpy_support.numpy_to_vtk(values, deep=True)
        array.SetName(name)
        data.GetPointData().AddArray(array)
    data.GetPointData().SetActiveScalars('color')
    # A vertex cell for each.
    vertices = vtk.vtkCellArray()
    for i in range(len(radii)):
        vertices.InsertNextCell(1, [i])
    data.SetVerts(vertices)
    return data


def srgb(linear):
    return numpy.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def ball_mapper(data, how):
    if how == 'impostors':
        mapper = vtk.vtkOpenGLSphereMapper()
        mapper.SetScaleArray('radius')
    else:
        ball = vtk.vtkSphereSource()
        ball.SetRadius(1)
        ball.SetThetaResolution(16)
        ball.SetPhiResolution(18)
        mapper = vtk.vtkGlyph3DMapper()
        mapper.SetSourceConnection(ball.GetOutputPort())
        mapper.SetScaleArray('radius')
        mapper.SetScaleModeToScaleByMagnitude()
    mapper.SetInputData(data)
    mapper.SelectColorArray('color')
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SetColorModeToDirectScalars()
    return mapper


def actor_of(mapper):
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetAmbient(0.28)
    look.SetDiffuse(0.8)
    look.SetSpecular(0.35)
    look.SetSpecularPower(64)
    return actor


def floor(scene):
    """A square of 60 m below the balls, with the squares of 0.5 m as a texture."""
    plane = vtk.vtkPlaneSource()
    plane.SetOrigin(-30, 0, 30)
    plane.SetPoint1(30, 0, 30)
    plane.SetPoint2(-30, 0, -30)
    color = 255 * srgb(numpy.array(scene['floor']))
    image = vtk.vtkImageData()
    image.SetDimensions(64, 64, 1)
    grid = (numpy.indices((64, 64)) // 32).sum(axis=0) % 2
    pixels = numpy.where(grid.reshape(-1, 1) == 1, color, 0.95 * color).astype(numpy.uint8)
    image.GetPointData().SetScalars(numpy_support.numpy_to_vtk(pixels, deep=True))
    texture = vtk.vtkTexture()
    texture.SetInputData(image)
    texture.RepeatOn()
    texture.InterpolateOn()
    texture.MipmapOn()
    scale = vtk.vtkTransformTextureCoords()
    scale.SetInputConnection(plane.GetOutputPort())
    scale.SetScale(60, 60, 1)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(scale.GetOutputPort())
    actor = actor_of(mapper)
    actor.GetProperty().SetSpecular(0)
    actor.SetTexture(texture)
    return actor


def window_of(scene, mapper, shadows, samples):
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(0.83, 0.85, 0.87)
    renderer.AddActor(actor_of(mapper))
    renderer.AddActor(floor(scene))
    camera = renderer.GetActiveCamera()
    camera.SetPosition(scene['eye'])
    camera.SetFocalPoint(scene['target'])
    camera.SetViewUp(0, 1, 0)
    camera.SetViewAngle(scene['fov'])
    camera.SetClippingRange(0.1, 60)
    light = vtk.vtkLight()
    light.SetLightTypeToSceneLight()
    light.SetFocalPoint(0, 1, 0)
    light.SetPosition([16 * x + (0, 1, 0)[i] for i, x in enumerate(scene['towards_light'])])
    light.SetColor([x for x in scene['light']])
    if shadows:
        # A cone that holds the balls and their shadows.
        light.PositionalOn()
        light.SetConeAngle(25)
    renderer.AutomaticLightCreationOff()
    renderer.AddLight(light)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(samples)
    window.SetSize(scene['size'])
    window.AddRenderer(renderer)
    if shadows:
        shadow = vtk.vtkShadowMapPass()
        shadow.GetShadowMapBakerPass().SetResolution(2048)
        passes = vtk.vtkRenderPassCollection()
        for step in (shadow.GetShadowMapBakerPass(), shadow):
            passes.AddItem(step)
        sequence = vtk.vtkSequencePass()
        sequence.SetPasses(passes)
        view = vtk.vtkCameraPass()
        view.SetDelegatePass(sequence)
        renderer.SetPass(view)
    return window


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    with open(sys.argv[1], encoding='utf-8') as file:
        scene = json.load(file)
    how, _, shadows = sys.argv[2].partition('_')
    data = ball_data(scene)
    window = window_of(scene, ball_mapper(data, how), bool(shadows), 4 if how == 'glyphs' else 0)
    places = numpy_support.vtk_to_numpy(data.GetPoints().GetData())
    draws, writes = [], []
    began = time.process_time()
    for number in range(PICTURES + 1):
        if number > 1 and time.process_time() - began > LONGEST:
            break
        places[:, 1] += 1e-3 if number % 2 == 0 else -1e-3
        start = time.process_time()
        data.GetPoints().Modified()
        data.Modified()
        window.Render()
        grab = vtk.vtkWindowToImageFilter()
        grab.SetInput(window)
        grab.ReadFrontBufferOff()
        grab.ShouldRerenderOff()
        grab.Update()
        drawn = time.process_time()
        writer = vtk.vtkPNGWriter()
        writer.SetInputData(grab.GetOutput())
        writer.SetCompressionLevel(1)
        writer.WriteToMemoryOn()
        writer.Write()
        # The first picture compiles shaders.
        if number > 0:
            draws.append(drawn - start)
            writes.append(time.process_time() - drawn)
    if len(sys.argv) == 4:
        with open(sys.argv[3], 'wb') as file:
            file.write(bytes(numpy_support.vtk_to_numpy(writer.GetResult())))
    print(f'{1e3 * statistics.median(draws):.2f},{1e3 * statistics.median(writes):.2f}')


if __name__ == '__main__':
    main()
