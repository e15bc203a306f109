"""different_blas.py PROGRAM WORK TEST...: runs blas_results under every BLAS of this machine and
compares what it prints; the tests, which the build runs under one of them, must pass under the
others too.

A library is put in place by a folder of links under WORK, first on LD_LIBRARY_PATH. HDLYAP_BLAS may
name further folders, one after another with ':' between them, each as one below /usr/lib/*/:
libblas.so.3, liblapack.so.3, and libopenblas.so.0 if it is OpenBLAS. Kernels of OpenBLAS are chosen
by OPENBLAS_CORETYPE. What is not there is skipped by name; two variants must have run.
"""
import glob
import os
import platform
import subprocess
import sys

LIBRARIES = ["openblas-openmp", "openblas-pthread", "openblas-serial", "reference"]
# by machine, with what the processor must have; an emulator may show its host in /proc/cpuinfo
FEATURES = {
    "x86_64": {
        "Prescott": ["sse3"],
        "Haswell": ["avx2", "fma"],
        "SkylakeX": ["avx512f", "avx512vl"],
    },
    "aarch64": {"armv8": [], "cortexa57": [], "thunderx": []},
}.get(platform.machine(), {})


def processor():
    try:
        with open("/proc/cpuinfo") as info:
            for line in info:
                if line.startswith("flags"):
                    return set(line.replace("pni", "sse3").split())
    except OSError:
        pass
    return set()


def files_of(name):
    """Where the three files of a library are, or None. The reference has cblas in libblas, and no
    libopenblas."""
    parents = glob.glob("/usr/lib/*/") + [
        p + "/" for p in os.environ.get("HDLYAP_BLAS", "").split(":") if p
    ]
    for parent in parents:
        blas, lapack = (
            (parent + "blas", parent + "lapack") if name == "reference" else (parent + name,) * 2
        )
        found = {
            "libblas.so.3": blas + "/libblas.so.3",
            "liblapack.so.3": lapack + "/liblapack.so.3",
            "libopenblas.so.0": blas
            + ("/libblas.so.3" if name == "reference" else "/libopenblas.so.0"),
        }
        if all(os.path.exists(path) for path in found.values()):
            return found
    return None


def kernels_of(name, flags):
    """Of the first library all that this processor has, of the others the first; None: not
    chosen."""
    suitable = [kernel for kernel in FEATURES if flags.issuperset(FEATURES[kernel])]
    if name == LIBRARIES[0]:
        for kernel in FEATURES.keys() - set(suitable):
            print(f"{name} {kernel}: not for this processor, skipped")
    else:
        suitable = suitable[:1]
    return [None] if name == "reference" or not suitable else suitable


def environment_of(folder, files, kernel):
    """In which the program loader finds these files first."""
    os.makedirs(folder, exist_ok=True)
    for link, target in files.items():
        path = os.path.join(folder, link)
        if os.path.lexists(path):
            os.remove(path)
        os.symlink(target, path)
    environment = dict(
        os.environ, LD_LIBRARY_PATH=folder, OMP_WAIT_POLICY="passive", GOMP_SPINCOUNT="0"
    )
    environment.pop("OPENBLAS_CORETYPE", None)
    if kernel:
        environment["OPENBLAS_CORETYPE"] = kernel
    return environment


def run(program, environment, label):
    done = subprocess.run(
        [program],
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        universal_newlines=True,
    )
    if done.returncode:
        sys.exit(
            f"{program} under {label}: exit status {done.returncode}\n"
            f"{done.stdout[-2000:]}{done.stderr}"
        )
    return done.stdout.splitlines()


def check_identity(lines, folder, name, kernel):
    """The library that was meant has run, not another one."""
    for line in lines[1:3]:
        if os.path.dirname(line.split()[2]) != folder:
            sys.exit(f"{name}: {line}, not from {folder}")
    library, its_kernel, threading = lines[0][len("blas ") :].rsplit(", ", 2)
    expected = (
        ("unknown BLAS", "unknown") if name == "reference" else ("OpenBLAS", kernel or its_kernel)
    )
    if not library.startswith(expected[0]) or its_kernel != expected[1]:
        sys.exit(f"{name} {kernel}: is {lines[0]}")
    if name.startswith("openblas-") and threading != name[len("openblas-") :]:
        sys.exit(f"{name}: threading is {threading}")


def compare(first, second, label):
    """Every number within the tolerances that both state; the largest difference and part of them,
    by kind."""
    if len(first) != len(second):
        sys.exit(f"{label}: {len(second)} numbers, not {len(first)}")
    used = {}
    for k, (a, b) in enumerate(zip(first, second)):
        kind, x, tolerance = a[0], float(a[1]), float(a[2])
        off, allowed = abs(x - float(b[1])), tolerance + float(b[2])
        if a[0] != b[0] or not off <= allowed:
            sys.exit(
                f"{label}: number {k}, {kind}: {a[1]} and {b[1]} differ by {off:.3g}, "
                f"allowed {allowed:.3g}"
            )
        largest = used.setdefault(kind, [0.0, 0.0])
        largest[0] = max(largest[0], off)
        largest[1] = max(largest[1], off / allowed if allowed else 0.0)
    return used


def main():
    program, work, *tests = sys.argv[1:]
    flags, results, libraries = processor(), {}, set()
    for name in LIBRARIES:
        files = files_of(name)
        if not files:
            print(f"{name}: not installed, skipped")
            continue
        for kernel in kernels_of(name, flags):
            label = f"{name} {kernel}" if kernel else name
            folder = os.path.join(work, name)
            environment = environment_of(folder, files, kernel)
            lines = run(program, environment, label)
            check_identity(lines, folder, name, kernel)
            for test in tests if name != LIBRARIES[0] else []:
                run(test, environment, label)
                print(f"{label}: {os.path.basename(test)} passed")
            results[label] = [line.split() for line in lines[3:]]
            libraries.add(name)
    first = next(iter(results), None)
    for label in list(results)[1:]:
        used = compare(results[first], results[label], f"{first} and {label}")
        print(f"{first} and {label}: {len(results[first])} numbers agree")
        for kind, (off, part) in used.items():
            print(f"    {kind}: apart by up to {off:.2g}, {part:.2g} of what is allowed")
    if len(results) < 2:
        sys.exit(f"{len(results)} variants have run: two are needed")
    print(f"{len(results)} variants of {len(libraries)} libraries")


main()
