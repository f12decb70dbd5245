"""The balls of carom_pictures as a scene of POV-Ray: an area light of 5 by 5 with soft shadows, no radiosity."""

import math

import povray_scene as pov


def write_povray(scene, path):
    style = pov.look_of('studio')
    eye, target = scene['eye'], scene['target']
    ahead = pov.unit(pov.add(target, pov.scaled(-1, eye)))
    right = pov.unit(pov.cross(ahead, [0, 1, 0]))
    up = pov.cross(right, ahead)
    tall = 2 * math.tan(math.radians(scene['fov']) / 2)
    wide = tall * scene['size'][0] / scene['size'][1]
    away = 1000
    towards = scene['towards_light']
    side = pov.unit(pov.cross([0, 1, 0], towards))
    across = 2 * pov.SOFTNESS * away
    with open(path, 'w', encoding='utf-8') as file:
        file.write(f'''#version 3.7;
global_settings {{ assumed_gamma 1 }}
camera {{ perspective location {pov.text(eye)} direction {pov.text(ahead)}
  right {pov.text(pov.scaled(wide, right))} up {pov.text(pov.scaled(tall, up))} }}
background {{ {pov.rgb(style['horizon'])} }}
light_source {{ {pov.text(pov.scaled(away, towards))}, {pov.rgb(scene['light'])}
  area_light {pov.text(pov.scaled(across, side))}, {pov.text(pov.scaled(across, pov.cross(towards, side)))}, 5, 5
  adaptive 1 jitter circular orient }}
#default {{ finish {{ ambient {pov.rgb(style["ambient"])} diffuse 1 }} }}
plane {{ y, 0 pigment {{ {pov.rgb(scene['floor'])} }} }}
''')
        looks = {}
        for center, radius, color in scene['balls']:
            name = looks.get(tuple(color))
            if name is None:
                name = looks[tuple(color)] = f'Look{len(looks)}'
                file.write(f'#declare {name} = texture {{ pigment {{ {pov.rgb(color)} }} '
                           f'finish {{ ambient {pov.rgb(style["ambient"])} diffuse 1 specular 0.35 roughness 1 / 64 }} }}\n')
            file.write(f'sphere {{ {pov.text(center)}, {radius:.9g} texture {{ {name} }} }}\n')
