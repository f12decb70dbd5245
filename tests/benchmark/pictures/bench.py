#!/usr/bin/python3
"""The cost of pictures, beside that of VTK, POV-Ray and x264.

    bench.py CAROM CAROM_PICTURES FOLDER [PART...]

PART: frames, film, start, memory; all of them without one. Prints tables, and writes FOLDER/pictures.csv.
"""

import csv
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

import cloud

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.abspath(os.path.join(HERE, '../../..'))
BALLS = (1, 100, 1000, 10000, 100000)
LONGEST = 180  # s of one picture; a program that takes longer has no more balls
ONE_THREAD = {'LP_NUM_THREADS': '0', 'LIBGL_ALWAYS_SOFTWARE': '1'}
MEMORY = '/dev/shm' if os.access('/dev/shm', os.W_OK) else None


def scene(name):
    return os.path.join(ROOT, 'scenes', name + '.yaml')


def output_of(*command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False,
                          env=os.environ | ONE_THREAD)
    if done.returncode != 0:
        sys.exit(f'bench: {" ".join(command[:4])} ended with {done.returncode}:\n{done.stderr[-2000:]}')
    return done.stdout


def succeeds(*command):
    try:
        return subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                              check=False).returncode == 0
    except OSError:
        return False


def times_of(command, environment=None, folder=None, longest=None):
    """Wall time and CPU time of a command and its children, s; None if it takes longer."""
    start = time.perf_counter()
    with tempfile.TemporaryFile() as said:
        child = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=said, stderr=said, cwd=folder,
                                 env=os.environ | (environment or {}))
        try:
            if longest:
                # A process that is waited for in this way has no CPU time to read. It is only looked at.
                while os.waitid(os.P_PID, child.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is None:
                    if time.perf_counter() - start > longest:
                        child.kill()
                        child.wait()
                        return None
                    time.sleep(0.01)
            _, status, used = os.wait4(child.pid, 0)
        except BaseException:
            child.kill()
            raise
        child.returncode = os.waitstatus_to_exitcode(status)
        if child.returncode != 0:
            said.seek(0)
            sys.exit(f'bench: {" ".join(command[:4])} ended with {child.returncode}:\n{said.read()[-2000:]}')
    return time.perf_counter() - start, used.ru_utime + used.ru_stime


def number(value):
    return '–' if value is None else f'{value:,.1f}' if value < 100 else f'{value:,.0f}'


def table(head, rows):
    print('| ' + ' | '.join(head) + ' |\n' + '| --- ' * len(head) + '|')
    for row in rows:
        print('| ' + ' | '.join(row) + ' |')
    print(flush=True)


class Bench:
    def __init__(self, carom, pictures, folder):
        self.carom, self.pictures, self.folder = os.path.abspath(carom), os.path.abspath(pictures), folder
        self.measured = []

    def record(self, part, case, program, quantity, value, unit):
        self.measured.append([part, case, program, quantity, '' if value is None else f'{value:.4g}', unit])

    # Frames.

    def carom_frame(self, balls):
        row = list(csv.DictReader(output_of(self.pictures, str(balls)).splitlines()))[0]
        return [float(row[key]) for key in ('draw_ms', 'png_ms')]

    def vtk_frame(self, work, how):
        text = output_of('xvfb-run', '-a', '/usr/bin/python3', os.path.join(HERE, 'vtk_pictures.py'),
                         os.path.join(work, 'scene.json'), how)
        return [float(x) for x in text.strip().split('\n')[-1].split(',')]

    @staticmethod
    def povray_frame(work):
        spent = times_of(['povray', f'+I{work}/scene.pov', f'+O{work}/scene.png', '+W1280', '+H720', '+FN8', '+A0.3',
                          '+WT1', '-D', '-GA'], longest=LONGEST)
        return None if spent is None else 1e3 * spent[1]

    def frames_of(self, balls, rounds, ways, traced):
        """Medians of all programs. `ways`: those of VTK; the slower ones are removed."""
        found = {'carom': []}
        with tempfile.TemporaryDirectory(dir=MEMORY) as work:
            output_of(self.pictures, str(balls), os.path.join(work, 'scene.json'))
            with open(os.path.join(work, 'scene.json'), encoding='utf-8') as file:
                cloud.write_povray(json.load(file), os.path.join(work, 'scene.pov'))
            for _ in range(rounds):
                found['carom'].append(self.carom_frame(balls))
                for how in list(ways):
                    found.setdefault(how, []).append(self.vtk_frame(work, how))
                fastest = min((sum(found[how][0]) for how in ways), default=0)
                ways[:] = [how for how in ways if sum(found[how][0]) < 1.5 * fastest]
                if traced:
                    found.setdefault('POV-Ray', []).append(self.povray_frame(work))
                    # What takes so long is measured once.
                    traced = found['POV-Ray'][-1] is not None and found['POV-Ray'][-1] < 20e3
        return found

    def frames(self, rounds=3):
        # Programs that are not installed are left out.
        has_vtk = all(succeeds(*command) for command in (('/usr/bin/python3', '-c', 'import vtk'), ('xvfb-run', '--help')))
        ways = ['impostors_shadows', 'glyphs_shadows'] if has_vtk else []
        has_povray = succeeds('povray', '--version')
        rows = []
        for balls in BALLS:
            found = self.frames_of(balls, rounds, ways, has_povray)
            medians = {}
            for program, values in found.items():
                if program == 'POV-Ray':
                    medians[program] = None if None in values else statistics.median(values)
                    self.record('frames', balls, program, 'picture', medians[program], 'ms')
                    continue
                draw, write = (statistics.median(column) for column in zip(*values))
                medians[program] = draw + write
                for quantity, value in (('draw', draw), ('png', write), ('picture', draw + write)):
                    self.record('frames', balls, program, quantity, value, 'ms')
                if program == 'carom':
                    parts = [number(draw), number(write)]
            own = medians['carom']
            vtk, how = min(((medians[how], how.split('_')[0]) for how in found if how.endswith('_shadows')), default=(0, ''))
            traced = medians.get('POV-Ray')
            rows.append([f'{balls:,}', *parts, number(own), f'{number(vtk)} by {how}, {vtk / own:.1f}×' if vtk else '–',
                         '–' if 'POV-Ray' not in medians else f'over {LONGEST * 1000:,}' if traced is None else
                         f'{number(traced)}, {traced / own:.0f}×'])
        table(['balls', 'carom: draws', 'PNG', 'both', 'VTK', 'POV-Ray'], rows)

    # A film.

    def film(self, rounds=5):
        with tempfile.TemporaryDirectory(dir=MEMORY) as work:
            arguments = self.recorded_film(work)
            frames = self.frames_in(work, arguments)
            alone = ['ffmpeg'] + ['file:' + os.path.join(work, 'input') if a == 'pipe:0' else a for a in arguments]
            spent = {'carom': [], 'x264': []}
            for i in range(rounds):
                spent['carom'].append(times_of(self.film_command(os.path.join(work, str(i)))))
                spent['x264'].append(times_of(alone, folder=work))
        rows = []
        for program, values in spent.items():
            wall, processor = (statistics.median(column) for column in zip(*values))
            self.record('film', 'gas_in_a_room', program, 'rate', frames / wall, 'frames/s')
            self.record('film', 'gas_in_a_room', program, 'processor', 1e3 * processor / frames, 'ms/frame')
            rows.append([program, number(frames / wall), number(1e3 * processor / frames)])
        preset = arguments[arguments.index('-preset') + 1]
        table([f'{frames} frames, preset {preset}', 'frames a second', 'CPU ms a frame'], rows)

    def film_command(self, folder):
        return [self.carom, 'run', scene('gas_in_a_room'), '--only', 'video', '--quiet', '-o', folder]

    def recorded_film(self, work):
        """The arguments that the program gives to ffmpeg; `work`/input receives the pictures."""
        real = output_of('sh', '-c', 'command -v ffmpeg').strip()
        tools = os.path.join(work, 'tools')
        os.mkdir(tools)
        with open(os.path.join(tools, 'ffmpeg'), 'w', encoding='utf-8') as file:
            file.write(f"#!/bin/sh\nprintf '%s\\n' \"$@\" > '{work}/arguments'\ntee '{work}/input' | '{real}' \"$@\"\n")
        os.chmod(file.name, 0o755)
        times_of(self.film_command(os.path.join(work, 'recorded')), {'PATH': tools + ':' + os.environ['PATH']})
        with open(os.path.join(work, 'arguments'), encoding='utf-8') as file:
            arguments = file.read().splitlines()
        if arguments[arguments.index('-pixel_format') + 1] != 'yuv420p':
            sys.exit('bench: the program gives ffmpeg other pictures than yuv420p')
        return arguments

    @staticmethod
    def frames_in(work, arguments):
        width, height = (int(x) for x in arguments[arguments.index('-video_size') + 1].split('x'))
        return os.path.getsize(os.path.join(work, 'input')) // (width * height * 3 // 2)

    # Start and memory.

    def start(self, rounds=9):
        libraries = [word for word in output_of('ldd', self.carom).split() if word.startswith('/')]
        files = [self.carom, scene('two_bowling_balls'), *libraries]
        settings = [f'output.frames.{key}' for key in ('size=[1280,720]', 'from=0', 'until=0')]
        spent = {'cold': [], 'warm': []}
        with tempfile.TemporaryDirectory(dir=MEMORY) as work:
            for i in range(rounds):
                for name, values in spent.items():
                    if name == 'cold':
                        forget(files)
                    values.append(1e3 * times_of(
                        [self.carom, 'run', scene('two_bowling_balls'), '--only', 'frames', '--quiet', '-o',
                         os.path.join(work, f'{name}{i}'), *[w for s in settings for w in ('--set', s)]])[0])
        for name, values in spent.items():
            self.record('start', 'two_bowling_balls', 'carom', name, statistics.median(values), 'ms')
        table(['start to the end of one picture, ms', 'median', 'fastest', 'slowest'],
              [[name, *map(number, (statistics.median(v), min(v), max(v)))] for name, v in spent.items()])

    def memory(self):
        rows = []
        for balls, pictures, size in ((100, 100000, (160, 90)), (1000, 1000, (1280, 720))):
            text = output_of(self.pictures, str(balls), str(pictures), *map(str, size))
            peaks = [float(row['peak_kB']) / 1024 for row in csv.DictReader(text.splitlines())]
            case = f'{pictures:,} pictures of {size[0]} × {size[1]}, {balls:,} balls'
            for tenth, peak in enumerate(peaks, 1):
                self.record('memory', case, 'carom', f'peak after {tenth}/10', peak, 'MiB')
            rows.append([case, number(peaks[0]), number(peaks[4]), number(peaks[-1])])
        table(['peak memory, MiB', 'after 1/10', 'after half', 'after all'], rows)

    def write(self):
        """Replaces the rows of the parts that were measured."""
        path = os.path.join(self.folder, 'pictures.csv')
        kept, new = [], {row[0] for row in self.measured}
        if os.path.exists(path):
            with open(path, encoding='utf-8', newline='') as file:
                kept = [row for row in list(csv.reader(file))[1:] if row[0] not in new]
        with open(path, 'w', encoding='utf-8', newline='') as file:
            writer = csv.writer(file, lineterminator='\n')
            writer.writerow(['part', 'case', 'program', 'quantity', 'value', 'unit'])
            writer.writerows(kept + self.measured)


def forget(files):
    """Asks the system to read these files from the disk again. Those that another program has mapped may stay."""
    for path in files:
        descriptor = os.open(path, os.O_RDONLY)
        os.posix_fadvise(descriptor, 0, 0, os.POSIX_FADV_DONTNEED)
        os.close(descriptor)


def main():
    parts = sys.argv[4:] or ['frames', 'film', 'start', 'memory']
    if len(sys.argv) < 4 or not set(parts) <= {'frames', 'film', 'start', 'memory'}:
        sys.exit(__doc__)
    bench = Bench(*sys.argv[1:4])
    for part in parts:
        getattr(bench, part)()
    bench.write()


if __name__ == '__main__':
    main()
