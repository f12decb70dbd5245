#!/usr/bin/python3
"""Ten scenes as drawn by carom and, to the right of it, by POV-Ray with radiosity: one by one and on one sheet.

    look.py CAROM SCENES_FOLDER OUTPUT_FOLDER [SCENE[=TIME]...]

Of any other scene the time of the picture is given, in s. Makes SCENE_carom.png and SCENE_povray.png of each scene in the
output folder, and sheet.png with two scenes a row.
"""

import math
import os
import subprocess
import sys

import yaml

HERE = os.path.dirname(os.path.abspath(__file__))
SIZE = (1280, 720)
# The time of the picture, s, and other settings.
SCENES = {'two_bowling_balls': (1.5, 'camera.fov=14'), 'billiard_break': (0.4,), 'ten_pins': (0.55,),
          'crates': (0.65,), 'gas_in_a_room': (1.0,), 'pile_at_rest': (8.0,), 'pyramid': (1.0,),
          'balls_in_a_box': (4.0,), 'rolling_off': (0.5,), 'wall_fly_over': (0.5,)}

# POV-Ray's values are linear and half as bright; carom's curve (src/raster/light.inc) and sRGB follow.
SEEN = '(val/maxval*2)'
TONED = f'if(lt({SEEN},0.7),{SEEN},1-0.09/(0.3+{SEEN}-0.7))'
CODED = f'maxval*(1.055*pow({TONED},1/2.4)-0.055)'
CODED = f'if(lt({SEEN},0.0031308),maxval*12.92*{SEEN},{CODED})'


def run(*command):
    done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        sys.exit(f'look: {" ".join(command[:3])} ended with {done.returncode}:\n{done.stdout[-2000:]}')


def ffmpeg(*words):
    run('ffmpeg', '-nostdin', '-hide_banner', '-loglevel', 'error', '-y', *words)


def pictures(carom, scenes, folder, scene, time, *settings):
    work = os.path.join(folder, scene)
    fps = 1 / time if time else 1
    settings = [*settings] + [f'output.frames.{key}={value}' for key, value in
                [('fps', repr(fps)), ('from', repr(time)), ('until', repr(time)), ('size', f'[{SIZE[0]},{SIZE[1]}]')]]
    settings += [f'output.gltf.fps={fps!r}']
    run(carom, 'run', os.path.join(scenes, scene + '.yaml'), '--only', 'frames,gltf', '--force', '-o', work,
        *[word for setting in settings for word in ('--set', setting)])
    frames = os.path.join(work, 'frames')
    os.replace(os.path.join(frames, sorted(os.listdir(frames))[0]), os.path.join(folder, f'{scene}_carom.png'))
    with open(os.path.join(work, 'scene.yaml'), encoding='utf-8') as file:
        resolved = yaml.safe_load(file)
    camera = resolved.get('camera', {})
    distance = math.dist(*[[float(x) for x in camera[key]] for key in ('eye', 'target')]) if 'eye' in camera else 0
    pov, linear = os.path.join(folder, scene + '.pov'), os.path.join(folder, scene + '_linear.png')
    with open(pov, 'w', encoding='utf-8') as file:
        subprocess.run([os.path.join(HERE, 'povray_scene.py'), os.path.join(work, 'animation.glb'), repr(time),
                        repr(distance), resolved.get('look', 'studio'), *resolved.get('obstacles', {})],
                       stdout=file, check=True)
    run('povray', f'+I{pov}', f'+O{linear}', f'+W{SIZE[0]}', f'+H{SIZE[1]}', '+FN16', 'File_Gamma=1.0', '+A0.1', '+AM2',
        '+R3', '-D', '-GA')
    ffmpeg('-i', linear, '-vf', f"format=rgb48le,lutrgb=r='{CODED}':g='{CODED}':b='{CODED}',format=rgb24",
           os.path.join(folder, f'{scene}_povray.png'))
    os.remove(linear)


def sheet(folder, scenes):
    files = [os.path.join(folder, f'{scene}_{program}.png') for scene in scenes for program in ('carom', 'povray')]
    small = ''.join(f'[{i}]scale=640:-2:flags=area[s{i}];' for i in range(len(files)))
    columns = min(4, len(files))
    places = '|'.join(f'{640 * (i % columns)}_{360 * (i // columns)}' for i in range(len(files)))
    stack = ''.join(f'[s{i}]' for i in range(len(files))) + f'xstack=inputs={len(files)}:layout={places}:fill=white'
    ffmpeg(*[word for file in files for word in ('-i', file)], '-filter_complex', small + stack,
           os.path.join(folder, 'sheet.png'))


def main():
    if len(sys.argv) < 4:
        sys.exit('usage: look.py CAROM SCENES_FOLDER OUTPUT_FOLDER [SCENE[=TIME]...]')
    carom, scenes, folder = sys.argv[1:4]
    os.makedirs(folder, exist_ok=True)
    chosen = dict(SCENES) if len(sys.argv) == 4 else {}
    for word in sys.argv[4:]:
        scene, _, time = word.partition('=')
        if not time and scene not in SCENES:
            sys.exit(f'look: {scene} needs a time, as in {scene}=1.5; those of {", ".join(SCENES)} are known')
        chosen[scene] = (float(time),) if time else SCENES[scene]
    for scene, how in chosen.items():
        print(scene, flush=True)
        pictures(carom, scenes, folder, scene, *how)
    sheet(folder, list(chosen))


if __name__ == '__main__':
    main()
