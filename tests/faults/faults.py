#!/usr/bin/python3
"""Small commands of carom under every fault: killed at each system call and at random instants, each call failing once
and for ever, limits of files, memory and file size, a tiny file system, other programs that hang or give wrong results,
interrupts.

usage: faults.py CAROM [short] [family=NAME] [command=NAME] [try=DETAIL]

Each try checks: the exit code is one of those documented and is right (0: every byte as undisturbed); there is a
message; no signal ends the program except the one sent; it ends in time; each file with its final name is whole. The
same command, undisturbed, then completes with the same bytes and leaves nothing else.
"""
import concurrent.futures
import hashlib
import json
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

# s: a disturbed command that takes longer hangs.
LIMIT = 40
# s, from an interrupt to the end.
PROMPT = 2.0
ROOT = os.path.dirname(os.path.abspath(__file__))

SCENE = """scene: 1
title: Two balls
gravity: [0, 0, 0]
balls:
  red: {mass: 10, radius: 0.11, restitution: 0.9, position: [-1, 0, 0], velocity: [2, 0, 0]}
  blue: {mass: 10, radius: 0.11, restitution: 0.9, position: [1, 0, 0], velocity: [-2, 0, 0]}
simulate: {duration: 1}
"""
TABLES = SCENE + "output: {trajectory: {every: 0.1}, collisions: true, energy: {every: 0.1}}\n"
FILM = SCENE + """camera: {eye: [0, 1, 5], target: [0, 0, 0]}
output:
  collisions: true
  frames: {fps: 4, size: [32, 18], samples: 1}
  video: {fps: 4, size: [32, 18], samples: 1}
"""
SWEEP = """sweep: 1
base: tables.yaml
grid: {balls.red.mass: [5, 10]}
compare: {measures: [energy_lost_J], charts: [{x: balls.red.mass, y: energy_lost_J}]}
"""


class Command:
    """A command line; `before`: command lines that make its starting folders."""

    def __init__(self, words, before=(), forks=False, draws=False):
        self.words, self.before, self.forks, self.draws = words.split(), [b.split() for b in before], forks, draws


COMMANDS = {
    "tables": Command("run tables.yaml -o out --progress none"),
    "packed": Command("run tables.yaml --set output.tables=csv.gz -o out --progress none"),
    "workbook": Command("run tables.yaml --set output.tables=xlsx -o out --progress none"),
    "film": Command("run film.yaml -o out --progress none", draws=True),
    "render": Command("render out --set camera.eye.y=5 --progress none", ["run film.yaml -o out"], draws=True),
    "still": Command("render out --at 0.25 --progress none", ["run film.yaml -o out"]),
    "plot": Command("plot out --progress none", ["run tables.yaml -o out"]),
    "sweep": Command("sweep sweep.yaml -o out -j 2 --progress none", forks=True),
    "gather": Command("gather out --progress none", ["sweep sweep.yaml -o out --shard 1/2",
                                                     "sweep sweep.yaml -o out --shard 2/2"], forks=True),
    "compare": Command("compare a b -o out --progress none",
                       ["run tables.yaml -o a", "run tables.yaml -o b --set balls.red.mass=5"]),
    "compare packed": Command("compare a b -o out --progress none",
                              ["run tables.yaml -o a --set output.tables=csv.gz",
                               "run tables.yaml -o b --set output.tables=csv.gz --set balls.red.mass=5"]),
}

# The errors of each failing call. (futex, which no program checks, ends in an abort of the C library.)
ERRORS = {
    "openat": ["EIO", "EMFILE", "EACCES"], "open": ["EIO"], "read": ["EIO"], "pread64": ["EIO"], "write": ["ENOSPC"],
    "pwrite64": ["ENOSPC"], "close": ["EIO"], "rename": ["EIO"], "renameat": ["EIO"], "renameat2": ["EIO"],
    "unlink": ["EIO"], "unlinkat": ["EIO"], "mkdir": ["ENOSPC"], "mkdirat": ["ENOSPC"], "rmdir": ["EIO"],
    "fsync": ["EIO"], "syncfs": ["EIO"], "newfstatat": ["EIO", "EACCES"], "fstat": ["EIO"], "stat": ["EIO"],
    "statx": ["EIO"], "access": ["EIO"], "readlink": ["EIO"], "getdents64": ["EIO"], "flock": ["EIO"],
    "ftruncate": ["EIO"], "clone": ["EAGAIN"], "clone3": ["EAGAIN"], "vfork": ["EAGAIN"], "wait4": ["ECHILD"],
    "socketpair": ["EMFILE"], "sendto": ["EPIPE"], "recvfrom": ["ECONNRESET"], "poll": ["ENOMEM"],
    "memfd_create": ["EMFILE"], "fcntl": ["EINVAL"], "pipe2": ["EMFILE"], "ioctl": ["EIO"],
    "sync_file_range": ["EIO"], "lseek": ["EIO"], "getcwd": ["ENOENT"], "dup": ["EMFILE"], "sched_getaffinity": ["EPERM"],
    "prctl": ["EPERM"], "sigaltstack": ["ENOMEM"], "rt_sigaction": ["EINVAL"], "rt_sigprocmask": ["EINVAL"],
    "getrusage": ["EFAULT"], "shutdown": ["ENOTCONN"],
}
# (A failing brk returns the former end, which cannot be injected: a limit of memory does it.)
SAMPLED = {"mmap": ["ENOMEM"], "mprotect": ["ENOMEM"]}


def tree(folder):
    """Hashes of all files below a folder; manifests without times and memory."""
    found = {}
    for place, folders, names in os.walk(folder):
        for name in folders:
            path = os.path.join(place, name)
            if not os.listdir(path):
                found[os.path.relpath(path, folder) + "/"] = "empty"
        for name in names:
            path = os.path.join(place, name)
            with open(path, "rb") as file:
                data = file.read()
            if name == "manifest.json":
                try:
                    record = json.loads(data)
                    for key in ("wall_times_s", "peak_memory_bytes"):
                        record.pop(key, None)
                    data = json.dumps(record).encode()
                except ValueError:
                    data = b"torn"
            found[os.path.relpath(path, folder)] = hashlib.sha256(data).hexdigest()
    return found


class Finished:
    def __init__(self, code, text, seconds, late=None):
        self.code, self.text, self.seconds, self.late = code, text, seconds, late


def go(words, folder, limits=(), env=None, interrupt=None, limit=LIMIT):
    """`limits`: of resource.setrlimit; `interrupt`: a signal and the seconds before it."""
    def prepare():
        os.setsid()
        for what, value in limits:
            resource.setrlimit(what, (value, value))

    start = time.monotonic()
    # (A pipe: a limit of file size does not apply. It has room for all output.)
    with subprocess.Popen(words, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, preexec_fn=prepare, env=env) as child:
        late = None
        try:
            if interrupt:
                try:
                    child.wait(interrupt[1])
                except subprocess.TimeoutExpired:
                    sent = time.monotonic()
                    os.kill(child.pid, interrupt[0])
                    child.wait(limit)
                    late = time.monotonic() - sent
            code = child.wait(limit)
        except subprocess.TimeoutExpired:
            code = "hang"
        try:
            os.killpg(child.pid, signal.SIGKILL)  # its remaining children
        except ProcessLookupError:
            pass
        child.wait()
        seconds = time.monotonic() - start
        return Finished(code, child.stdout.read().decode(errors="replace"), seconds, late)


class Bench:
    """The starting folders of all commands, and their undisturbed results."""

    def __init__(self, carom, base):
        self.carom, self.base = carom, base
        self.reference, self.former, self.counts, self.seconds = {}, {}, {}, {}
        self.start = {}
        # The program before it reads its command line.
        self.loading = self.count(["--version"], base, False)

    def prepare(self, name):
        if name in self.reference:
            return
        command = COMMANDS[name]
        folder = os.path.join(self.base, "start." + name)
        os.mkdir(folder)
        for file, text in (("tables.yaml", TABLES), ("film.yaml", FILM), ("sweep.yaml", SWEEP)):
            with open(os.path.join(folder, file), "w") as out:
                out.write(text)
        for words in command.before:
            done = go([self.carom] + words, folder)
            if done.code != 0:
                sys.exit("the undisturbed command fails: %s\n%s" % (words, done.text))
        self.start[name] = folder
        self.former[name] = tree(os.path.join(folder, "out"))
        place = self.fresh(name)
        done = go([self.carom] + command.words, place)
        if done.code != 0:
            sys.exit("the undisturbed command fails: %s\n%s" % (command.words, done.text))
        self.reference[name], self.seconds[name] = tree(os.path.join(place, "out")), done.seconds
        shutil.rmtree(place)

    def fresh(self, name):
        place = tempfile.mkdtemp(dir=self.base)
        shutil.copytree(self.start[name], place, dirs_exist_ok=True, symlinks=True)
        return place

    def count(self, words, folder, forks):
        """How often each system call is made, by the process or thread that makes it most often."""
        log = os.path.join(folder, "strace.log")
        go(["strace", "-o", log] + (["-f"] if forks else []) + [self.carom] + words, folder, limit=120)
        most, calls = {}, {}
        with open(log, errors="replace") as lines:
            for line in lines:
                who = ""
                if forks:
                    who, _, line = line.partition(" ")
                    line = line.lstrip()
                call = line.partition("(")[0]
                if call.isidentifier():
                    calls[who, call] = calls.get((who, call), 0) + 1
        os.remove(log)
        for (_, call), count in calls.items():
            most[call] = max(most.get(call, 0), count)
        return most

    def calls(self, name):
        if name not in self.counts:
            place = self.fresh(name)
            self.counts[name] = self.count(COMMANDS[name].words, place, COMMANDS[name].forks)
            shutil.rmtree(place)
        return self.counts[name]


# ---- tries: (family, command, detail); detail is a text with all parameters

def instants(bench, name, calls):
    for call in sorted(calls):
        count = bench.calls(name).get(call, 0)
        for n in range(max(1, bench.loading.get(call, 0)), count + 1):
            yield call, n


def sampled(bench, name):
    rng = random.Random(name)
    for call in SAMPLED:
        count = bench.calls(name).get(call, 0)
        first = max(1, bench.loading.get(call, 0))
        for n in sorted(rng.sample(range(first, count + 1), min(12, max(0, count + 1 - first)))):
            yield call, n


def tries(bench, name):
    known = [c for c in bench.calls(name) if c in ERRORS]
    for call, n in instants(bench, name, known):
        yield "kill at a call", "%s %d" % (call, n)
        for error in ERRORS[call]:
            yield "call fails once", "%s %d %s" % (call, n, error)
        yield "call fails for ever", "%s %d %s" % (call, n, ERRORS[call][0])
    for call, n in sampled(bench, name):
        yield "call fails once", "%s %d ENOMEM" % (call, n)
        yield "call fails for ever", "%s %d ENOMEM" % (call, n)
    rng = random.Random(name)
    for k in range(40):
        yield "kill at random", "%.4f" % (rng.random() * bench.seconds[name])
    for k in range(10):
        yield "interrupt", "%s %.4f" % (("INT", "TERM")[k % 2], rng.random() * bench.seconds[name])
    for files in list(range(3, 24)) + [32, 48]:
        yield "limit of files", str(files)
    for size in (0, 1, 100, 500, 1000, 2000, 4096, 6000, 8192, 10000, 16384, 32768, 65536):
        yield "limit of file size", str(size)
    for megabytes in list(range(20, 200, 20)) + list(range(200, 1600, 100)):
        yield "limit of memory", str(megabytes)
    if os.geteuid() == 0:
        for size in (4, 8, 12, 16, 20, 24, 28, 32, 40, 48, 64, 96, 128, 256):
            yield "tiny file system", "%dk" % size
    if COMMANDS[name].draws:
        for detail in PROGRAMS:
            yield "other programs", detail


PROGRAMS = {
    "ffmpeg missing": None,
    "ffmpeg fails": "cat > /dev/null; echo broken >&2; exit 3",
    "ffmpeg dies": "kill -SEGV $$",
    "ffmpeg hangs, INT": "exec sleep 1000",
    "ffmpeg hangs, TERM": "exec sleep 1000",
    "ffmpeg hangs at its end, INT": "cat > /dev/null; exec sleep 1000",
    "ffmpeg ends at once": "exit 0",
    "ffmpeg writes nothing": "cat > /dev/null; exit 0",
    "ffmpeg writes no film": "cat > /dev/null; echo nothing > film.mp4; exit 0",
    "ffmpeg writes half a film": "head -c 3456 | REAL \"$@\"",
    "ffprobe hangs, INT": "exec sleep 1000",
    "ffprobe fails": "echo broken >&2; exit 1",
    "ffprobe lies": "echo 1000000",
}


def other_program(detail, place):
    """A PATH on which ffmpeg or ffprobe is replaced."""
    bin_folder = os.path.join(place, "bin")
    os.mkdir(bin_folder)
    name = detail.split()[0]
    for program in ("ffmpeg", "ffprobe"):
        if program != name:
            os.symlink(shutil.which(program), os.path.join(bin_folder, program))
    if PROGRAMS[detail] is not None:
        path = os.path.join(bin_folder, name)
        with open(path, "w") as script:
            # (the tools of the script itself)
            script.write("#!/bin/sh\nPATH=/usr/bin:/bin\n" + PROGRAMS[detail].replace("REAL", shutil.which(name)) + "\n")
        os.chmod(path, 0o755)
    return bin_folder


def disturbed(bench, name, family, detail, place):
    """Runs the command under the fault. Returns its end and a function that removes the fault."""
    command = COMMANDS[name]
    words = [bench.carom] + command.words
    part = detail.split()
    trace = ["strace", "-qq", "-o", "/dev/null"] + (["-f"] if command.forks else [])
    if family == "kill at a call":
        # (Every process that gets there is killed, the worst case for several.)
        return go(trace + ["-e", "trace=" + part[0], "-e", "inject=%s:signal=KILL:when=%s" % tuple(part)] + words, place)
    if family in ("call fails once", "call fails for ever"):
        when = part[1] + ("+" if family == "call fails for ever" else "")
        return go(trace + ["-e", "trace=" + part[0], "-e", "inject=%s:error=%s:when=%s" % (part[0], part[2], when)] +
                  words, place)
    if family == "kill at random":
        return go(words, place, interrupt=(signal.SIGKILL, float(detail)))
    if family == "interrupt":
        return go(words, place, interrupt=(getattr(signal, "SIG" + part[0]), float(part[1])))
    if family == "limit of files":
        return go(words, place, [(resource.RLIMIT_NOFILE, int(detail))])
    if family == "limit of file size":
        return go(words, place, [(resource.RLIMIT_FSIZE, int(detail))])
    if family == "limit of memory":
        return go(words, place, [(resource.RLIMIT_AS, int(detail) << 20)])
    if family == "other programs":
        env = dict(os.environ, PATH=other_program(detail, place))
        stop = (getattr(signal, "SIG" + part[-1]), 2 + bench.seconds[name]) if "hangs" in detail else None
        return go(words, place, env=env, interrupt=stop)
    if family == "tiny file system":
        out = os.path.join(place, "out")
        os.makedirs(out, exist_ok=True)
        kept = os.path.join(place, "kept")
        os.rename(out, kept)
        os.mkdir(out)
        subprocess.run(["mount", "-t", "tmpfs", "-o", "size=" + detail, "tmpfs", out], check=True)
        full = subprocess.run(["cp", "-a", kept + "/.", out], stderr=subprocess.DEVNULL).returncode
        shutil.rmtree(kept)
        if full != 0:
            # The starting folder has no room.
            return None
        return go(words, place)
    raise ValueError(family)


def wrong_end(name, family, detail, done, place, reference, former):
    """The error in the end of the command; empty: none."""
    if done.code == "hang":
        return "it hangs"
    for word in ("ended by signal 11", "ended by signal 6", "terminate called", "filesystem error", "basic_"):
        if word in done.text:
            return "a crash, or output that is no message: " + done.text.strip()[-300:]
    if done.late is not None and family in ("interrupt", "other programs") and done.late > PROMPT:
        return "%.1f s from the interrupt to the end" % done.late
    # Before the program handles signals, or is loaded, nothing has begun.
    unheard = family in ("interrupt", "other programs") and done.code in (-2, -15)
    unloaded = done.code == 127 and ("loading shared libraries" in done.text or "cannot allocate TLS" in done.text)
    if (unheard or unloaded) and tree(os.path.join(place, "out")) == former:
        return ""
    killed = family in ("kill at a call", "kill at random")
    allowed = {0, 1, 2, 3, 130, 143} | ({-9, 137} if killed else set())
    # LLVM, which draws, ends the program if it gets no memory for its code ("LLVM ERROR: Unable to allocate section
    # memory!"), or crashes; nothing may be torn by that.
    memory = family == "limit of memory" or (family.startswith("call") and detail.split()[0] in SAMPLED)
    if memory and COMMANDS[name].draws:
        allowed |= {-6, -11}
    if done.code not in allowed:
        return "exit code %s: %s" % (done.code, done.text.strip()[-300:])
    if done.code == 2 and family in ("limit of file size", "tiny file system"):
        return "exit code 2: " + done.text.strip()[-300:]
    now = tree(os.path.join(place, "out"))
    if done.code == 0 and now != reference:
        wrong = sorted(k for k in set(now) | set(reference) if now.get(k) != reference.get(k))
        return "exit code 0, and wrong: %s\n%s" % (wrong[:8], done.text.strip()[-300:])
    if done.code in (1, 2, 3) and not done.text.strip():
        # (Where stderr fails too, the message cannot be written.)
        if not family.startswith("call fails for ever"):
            return "exit code %s without a message" % done.code
    for file, digest in now.items():
        hidden = any(part.startswith(".") for part in file.split("/"))
        if hidden or file.endswith("/") or file.endswith("error.txt"):
            continue
        # (If runs of a sweep failed, the comparison differs; its manifest has the hashes.)
        if digest not in (reference.get(file), former.get(file)) and not (done.code == 3 and is_listed(place, file)):
            return "torn, or another run's: " + file
    return ""


def is_listed(place, file):
    """Whether the manifest in out/ is whole and has the hash of this file."""
    with open(os.path.join(place, "out/manifest.json")) as text:
        listed = {record["name"]: record["sha256"] for record in json.load(text)["files"]}
    with open(os.path.join(place, "out", file), "rb") as data:
        return file == "manifest.json" or listed.get(file) == hashlib.sha256(data.read()).hexdigest()


def attempt(bench, name, family, detail):
    """The error; empty: none; None: the try was not possible."""
    reference, former = bench.reference[name], bench.former[name]
    place = bench.fresh(name)
    out = os.path.join(place, "out")
    try:
        done = disturbed(bench, name, family, detail, place)
        if done is None:
            return None
        why = wrong_end(name, family, detail, done, place, reference, former)
        if why:
            return why
        if family == "tiny file system":
            subprocess.run(["mount", "-o", "remount,size=64m", out], check=True)
        again = go([bench.carom] + COMMANDS[name].words, place)
        if again.code != 0:
            return "then the same command: exit code %s: %s" % (again.code, again.text.strip()[-300:])
        now = tree(out)
        if now != reference:
            wrong = sorted(k for k in set(now) | set(reference) if now.get(k) != reference.get(k))
            return "then the same command leaves: %s" % wrong[:8]
        return ""
    finally:
        if family == "tiny file system":
            subprocess.run(["umount", "-l", out], stderr=subprocess.DEVNULL)
        shutil.rmtree(place, ignore_errors=True)


def short_part(all_tries):
    """Evenly spaced tries of each family and command, the same ones each time."""
    lots = {}
    for one in all_tries:
        lots.setdefault(one[:2], []).append(one)
    chosen = []
    for lot in lots.values():
        few = 2 if lot[0][0].startswith("call") else 1
        chosen += [lot[(2 * k + 1) * len(lot) // (2 * few)] for k in range(min(few, len(lot)))]
    return chosen


def main():
    # Signals that a background job of a plain shell ignores, the commands would ignore too.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    carom = os.path.abspath(sys.argv[1])
    options = dict(word.partition("=")[::2] for word in sys.argv[2:])
    if shutil.which("strace") is None:
        print("strace is not installed: nothing is tried")
        return 77
    roomy = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
    base = tempfile.mkdtemp(prefix="carom-faults-", dir=roomy)
    held, tried, failures = {}, {}, []
    try:
        bench = Bench(carom, base)
        chosen = []
        for name in COMMANDS:
            if options.get("command", name) != name:
                continue
            bench.prepare(name)
            if "try" in options:
                chosen.append((options["family"], name, options["try"]))
                continue
            chosen += [(family, name, detail) for family, detail in tries(bench, name)
                       if options.get("family", family) == family]
        if "short" in options:
            chosen = short_part(chosen)
        if "every" in options:
            chosen = chosen[:: int(options["every"])]
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            for one, why in zip(chosen, pool.map(lambda t: attempt(bench, t[1], t[0], t[2]), chosen)):
                family, name, detail = one
                if why is None:
                    continue
                tried[family] = tried.get(family, 0) + 1
                held[family] = held.get(family, 0) + (why == "")
                if why:
                    failures.append(one)
                    print("FAILED %s, %s, %s\n  %s\n  again: %s %s 'family=%s' command=%s 'try=%s'" %
                          (family, name, detail, why.replace("\n", "\n  "), os.path.relpath(__file__), sys.argv[1],
                           family, name, detail), flush=True)
    finally:
        shutil.rmtree(base, ignore_errors=True)
    print("%-22s %7s %7s" % ("family", "tried", "held"))
    for family in sorted(tried):
        print("%-22s %7d %7d" % (family, tried[family], held[family]))
    print("%-22s %7d %7d" % ("all", sum(tried.values()), sum(held.values())))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
