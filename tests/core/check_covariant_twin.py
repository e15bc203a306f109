#!/usr/bin/python3
"""check_covariant_twin.py PROGRAM: what the core says of covariant vectors is what this program
finds, which has its own disks, tangent maps and way to the vectors, in extended precision.

PROGRAM (covariant_looks.c) prints the disks' states every so often, and what it says of its
windows. From each state the disks move here by themselves to the next one, and the tangent map M
with them: nothing has the time to become chaos. No vector is carried back through triangles [T16]:
Gram-Schmidt vectors F come from the past by M, others, W, from the future by the transpose of M,
and vector l is what the first l of F have in common with the complement of the first l - 1 of W: F
U^-1, where W^T F = L U (Kuptsov and Parlitz, J. Nonlinear Sci. 22, 727 (2012)).

A tolerance is what rounding and transients can do to the vectors V, to first order. A map that is
off by dM adds V'^-1 dM V to the parts X that each vector has of the others; parts of slower ones
come from the past, those of faster ones from the future, and go on with the ratio of growth. At the
ends of the transients X is that of anything. dM is ROUNDING times the size of M and what M changes
by with the disks' state, which one random shift of all positions and momenta shows.
"""
import itertools
import math
import os
import subprocess
import sys
import unittest

# matrices are small: threads would only wait
os.environ.update(OPENBLAS_NUM_THREADS='1', OMP_NUM_THREADS='1')
import numpy as np  # noqa: E402

PROGRAM = sys.argv[1]
# numbers of 80 bits; where there are none of these, others are a hundred times as slow
EXTENDED = np.longdouble if np.finfo(np.longdouble).nmant == 63 else float
EPS = np.finfo(float).eps
# each of the few events of a piece rounds its time, places and momenta, of 5 at most, some times
ROUNDING = 32 * EPS
START = 100  # random vectors may have as little as a hundredth of a vector that is looked for
SHIFT = 2.0 ** -(np.finfo(EXTENDED).nmant // 2)  # small enough for a slope, far above rounding
RANK = 1e-6  # [T11]
BINS = 90
RESOLVED = 1e-5  # a vector that is known better than this says something
EQUILIBRATION, TRANSIENT, AVERAGED = 16, 200, 12
POSITIVE, ALL, INDEPENDENT = -1, -2, -3
MADE = {  # of values and tolerances of all looks, the present one last
    'now': lambda values, tolerances: (values[-1], tolerances[-1]),
    'mean': lambda values, tolerances: (values.mean(0), tolerances.mean(0)),
    'least': lambda values, tolerances: (values.min(0), tolerances.max(0)),
    'sum': lambda values, tolerances: (values.sum(0), tolerances.sum(0)),
}


# ---- disks and their tangent map --------------------------------------------------------------


class Disks:
    def __init__(self, box, walls):
        self.box, self.walls = np.array(box, EXTENDED), np.array(walls, bool)
        shifts = itertools.product(*[[0] if wall else range(-2, 3) for wall in walls])
        self.images = np.array(list(shifts)) * self.box

    def wrapped(self, q):
        return q - np.where(self.walls, 0, np.floor(q / self.box) * self.box)

    def next_pair(self, q, p):
        """Time, disks, image of the second one."""
        i, j = np.triu_indices(len(q), 1)
        r, v = (q[j] - q[i])[:, None] + self.images, (p[j] - p[i])[:, None]
        b, c, vv = (r * v).sum(2), (r * r).sum(2) - 1, (v * v).sum(2)
        root = np.sqrt(np.maximum(b * b - vv * c, 0))
        t = np.where((b < 0) & (root > 0), c / (root - b), np.inf)
        pair, image = np.unravel_index(t.argmin(), t.shape)
        return t[pair, image], i[pair], j[pair], self.images[image]

    def next_wall(self, q, p):
        """Time, disk, direction."""
        edge = np.where(p > 0, self.box - EXTENDED(0.5), EXTENDED(0.5))
        t = np.where(self.walls, (edge - q) / p, np.inf)
        return (t.min(), *np.unravel_index(t.argmin(), t.shape))

    def fly(self, state, time):
        """State after that time, and the tangent map to there; rows: all q, then all p."""
        n = len(state)
        q, p = state.reshape(2, -1, 2).copy()
        x = np.eye(n, dtype=EXTENDED).reshape(2, -1, 2, n)
        while True:
            q = self.wrapped(q)
            pair, wall = self.next_pair(q, p), self.next_wall(q, p)
            dt = min(pair[0], wall[0], time)
            q += dt * p
            x[0] += dt * x[1]
            time -= dt
            if time == 0:
                return np.concatenate([self.wrapped(q).ravel(), p.ravel()]), x.reshape(n, n)
            if dt == pair[0]:
                collide(q, p, x, *pair[1:])
            else:
                p[wall[1:]] *= -1
                x[(slice(None), *wall[1:])] *= -1

    def apart(self, one, other):
        """Difference of two states."""
        off = (one - other).reshape(2, -1, 2)
        off[0] -= np.where(self.walls, 0, np.round(off[0] / self.box) * self.box)
        return off.ravel()


def collide(q, p, x, i, j, image):
    """As C. Dellago, H. A. Posch and W. G. Hoover have it, Phys. Rev. E 53, 1485 (1996)."""
    n, v = q[j] + image - q[i], p[j] - p[i]
    n /= np.sqrt(n @ n)
    dq, dp = x[:, j] - x[:, i]
    displaced = dq - np.outer(v, n @ dq / (v @ n))  # where they touch, sooner or later
    kick = np.outer(n, n @ dp + v @ displaced) + (v @ n) * displaced
    for disk, sign in ((i, 1), (j, -1)):
        x[0, disk] += sign * np.outer(n, n @ dq)
        x[1, disk] += sign * kick
        p[disk] += sign * (v @ n) * n


# ---- vectors ----------------------------------------------------------------------------------


def orthonormal(a):
    """Of the same nested spans: a triangle in double precision does nearly all of it."""
    b = a @ np.triu(np.linalg.inv(np.linalg.qr(a.astype(float))[1]))
    off = b.T @ b - np.eye(len(a))
    return b - b @ (np.triu(off, 1) + np.diag(np.diag(off) / 2))


def lengths(a):
    return np.sqrt((a * a).sum(0))


def inverse_upper(a):
    """U^-1, where a = L U."""
    u, c = a.copy(), np.eye(len(a), dtype=EXTENDED)
    for k in range(len(a)):
        u[k + 1 :] -= np.outer(u[k + 1 :, k] / u[k, k], u[k])
    for k in reversed(range(len(a))):
        c[k] = (c[k] - u[k, k + 1 :] @ c[k + 1 :]) / u[k, k]
    return c


class Path:
    """Covariant vectors at the times of all states, and what each grows by from one to the next."""

    def __init__(self, disks, states):
        self.told, self.times, self.states = states, states[:, 0], states[:, 1:].astype(EXTENDED)
        self.n, self.maps, self.change = self.states.shape[1], [], []
        self.worst = [0.0, 0.0]  # rounding of a state, of a slope: parts of what is allowed
        random = np.random.RandomState(1)
        for k, time in enumerate(np.diff(self.times)):
            self.add_piece(disks, k, time, random.choice([-1, 1], self.n))
        first = random.standard_normal((2, self.n, self.n)).astype(EXTENDED)
        self.frames, future = [orthonormal(first[0])], [orthonormal(first[1])]
        for m in self.maps:
            self.frames.append(orthonormal(m @ self.frames[-1]))
        for m in reversed(self.maps):
            future.append(orthonormal(m.T @ future[-1]))
        self.vectors = [f @ inverse_upper(w.T @ f) for f, w in zip(self.frames, future[::-1])]
        self.vectors = [v / lengths(v) for v in self.vectors]
        self.grown = np.array([lengths(m @ v) for m, v in zip(self.maps, self.vectors)], float)
        self.added = [self.added_in(k) for k in range(len(self.maps))]
        self.slower = self.parts_of_slower()

    def add_piece(self, disks, k, time, shift):
        state, m = disks.fly(self.states[k], time)
        shifted, other = disks.fly(self.states[k] + SHIFT * shift, time)
        size, change = np.sqrt((m * m).sum()), np.abs(other - m) / SHIFT
        off = np.abs(disks.apart(state, self.states[k + 1])).max()
        slope = disks.apart(shifted, state) / SHIFT - (m + other) @ shift / 2
        # what is left is rounding and of third order, about the second one squared
        rounding = 64 * np.finfo(EXTENDED).eps / SHIFT
        allowed = rounding * size + SHIFT**2 * (change**2).sum() / size
        parts = off / (ROUNDING * size), np.abs(slope).max() / allowed
        self.worst = np.maximum(self.worst, parts)
        self.maps.append(m)
        self.change.append(change.astype(float))

    def inverse(self, k):
        return np.abs(np.linalg.inv(self.vectors[k].astype(float)))

    def added_in(self, k):
        """To X of the piece's end, times growth."""
        inverse, size = self.inverse(k + 1), float(np.sqrt((self.maps[k] ** 2).sum()))
        change = inverse @ self.change[k] @ np.abs(self.vectors[k].astype(float))
        return ROUNDING * (change + size * inverse.sum(1)[:, None])

    def anything(self, k):
        return START * np.repeat(self.inverse(k).sum(1)[:, None], self.n, 1)

    def parts_of_slower(self):
        """X of all times, from the past."""
        x = [np.tril(self.anything(0), -1)]
        for added, grown in zip(self.added, self.grown):
            x.append(np.tril(grown[:, None] * x[-1] + added, -1) / grown)
        return x

    def parts_of_faster(self, first, last):
        """{time: X} from the future, that begins at `last`."""
        x = {last: np.triu(self.anything(last), 1)}
        for k in range(last - 1, first - 1, -1):
            x[k] = np.triu(x[k + 1] * self.grown[k] + self.added[k], 1) / self.grown[k][:, None]
        return x


# ---- fields, of which vectors have weights ----------------------------------------------------


def functions(coordinate, box, wall, nodes, transverse):
    """[(function, derivative)] of one coordinate [T10]."""
    k = math.pi * nodes / (box - 1) if wall else 2 * math.pi * nodes / box
    cosine, sine = np.cos(k * (coordinate - wall / 2)), np.sin(k * (coordinate - wall / 2))
    both = [(cosine, -k * sine), (sine, k * cosine)]
    wanted = transverse if wall else None
    return [f for sines, f in enumerate(both) if (nodes or not sines) and wanted in (None, sines)]


class Subspace:
    def __init__(self, disks, state, transverse, *nodes):
        q, p = state.astype(float).reshape(2, -1, 2)
        x, y = (functions(*a, transverse) for a in zip(q.T, disks.box, disks.walls, nodes))
        products = [(f * g, df * g, f * dg) for g, dg in y for f, df in x]
        slopes = [(dy, -dx) if transverse else (dx, dy) for _, dx, dy in products]
        columns = [*slopes, *([] if transverse else [p.T * a for a, _, _ in products])]
        self.fields = np.array([np.transpose(c).ravel() for c in columns], float).T
        self.fields /= lengths(self.fields)
        value, vector = np.linalg.eigh(self.fields.T @ self.fields)
        kept = value > RANK
        self.least = value[kept].min()
        self.inverse = (vector[:, kept] / value[kept]) @ vector[:, kept].T @ self.fields.T
        half = len(products)
        self.parts = [slice(None)] + ([] if transverse else [slice(half), slice(half, None)])

    def measure(self, halves, tolerance):
        """Coefficients; weights of all, L and P (0 of T) [T11]."""
        c, rounding = self.inverse @ halves, 64 * EPS / self.least
        off = tolerance / np.sqrt(self.least)
        size = np.array([lengths(self.fields[:, part] @ c[part]) for part in self.parts])
        size = np.pad(size, ((0, 3 - len(size)), (0, 0)))
        turn = np.sqrt(len(c)) * off
        weights = size**2, (2 * size + turn) * turn + rounding
        return (c, off + rounding + np.zeros(c.shape)), weights


# ---- a look -----------------------------------------------------------------------------------


def half_of(vectors, half):
    return vectors.reshape(2, -1, vectors.shape[1])[half]


def angles_between(a, b):
    """Principal ones, smallest first."""
    a, b = sorted((np.linalg.qr(a)[0], np.linalg.qr(b)[0]), key=lambda x: -x.shape[1])
    cosines = np.linalg.svd(a.T @ b)[1]
    return np.arctan2(np.linalg.svd(b - a @ (a.T @ b))[1][::-1], cosines)


def turned(v, x, cols):
    """How far parts X turn the space of these columns."""
    parts = np.delete(x, cols, 0)[:, cols].sum(0)
    return np.sqrt((parts**2).sum()) / np.linalg.svd(v[:, cols])[1][-1]


class Look:
    """seen: {name: (values, tolerances)} of the first n vectors, at time k of a path."""

    def __init__(self, path, scene, k, slower, faster, n):
        v, x, zero = path.vectors[k].astype(float), slower + faster, scene.zero
        self.n, self.scene, self.state = n, scene, path.states[k].astype(float)
        unstable = (path.n - zero) // 2
        self.turn = x.sum(0)[:n]
        self.turn[unstable : unstable + zero] = np.inf  # no directions of their own
        self.seen = {}
        for half, name in enumerate(('dq_', 'dp_')):
            self.measure(name, v[:, :n], self.turn, half)
        space = np.array([0] + [turned(v, slower, range(k + 1)) for k in range(n)])
        self.measure('frame_', path.frames[k].astype(float)[:, :n], space[1:] + space[:-1], 0)
        self.measure_shape(v[:, :n])
        if n == path.n:
            self.measure_spaces(v, x, np.split(range(n), [unstable, unstable + zero]))

    def measure(self, name, vectors, turn, half):
        seen, scene, u = {}, self.scene, half_of(vectors, half)
        seen['norm'] = lengths(u), turn
        each = [
            Subspace(scene.disks, self.state, *s).measure(u / lengths(u), 2 * turn / lengths(u))
            for s in scene.subspaces
        ]
        for k, what in enumerate(('coefficient', 'weight')):
            if each:
                seen[what] = tuple(np.concatenate(values) for values in zip(*[e[k] for e in each]))
        p = self.state.reshape(2, -1, 2)[1]
        null = np.array([np.resize(axis, p.shape) for axis in np.diag(~scene.disks.walls)] + [p])
        null = null.reshape(3, -1) / np.maximum(lengths(null.reshape(3, -1).T), EPS)[:, None]
        parts = sum((null @ half_of(vectors, h)) ** 2 for h in (0, 1))
        seen['null'] = parts, np.resize(2 * turn, parts.shape)
        self.seen.update({name + what: value for what, value in seen.items()})

    def measure_shape(self, v):
        """-m ln m of a disk's share m, a square, changes by up to twice what its part does."""
        turn, dq, dp = self.turn, half_of(v, 0), half_of(v, 1)
        share = (dq**2 + dp**2).reshape(-1, 2, self.n).sum(1)
        self.seen['entropy'] = -(share * np.log(share)).sum(0), 2 * len(share) * turn
        size = lengths(dq), lengths(dp)
        cosine = np.abs((dq * dp).sum(0)) / size[0] / size[1]
        self.seen['cosine'] = cosine, 2 * turn / size[0] + 2 * turn / size[1]
        pairs = [angles_between(*v[:, k : k + 2].T[..., None])[0] for k in range(self.n - 1)]
        self.seen['neighbours'] = np.array(pairs), turn[1:] + turn[:-1]
        self.seen['apart'] = np.zeros(self.n), 2 * turn

    def measure_spaces(self, v, x, space):
        off = [turned(v, x, cols) for cols in space]
        pairs = ((0, 2), (0, 1), (1, 2))
        found = [angles_between(v[:, space[a]], v[:, space[b]]) for a, b in pairs]
        tolerance = np.array([off[a] + off[b] for a, b in pairs])
        bins = np.linspace(0, math.pi / 2, BINS + 1)
        counts = [[np.histogram(f[:m], bins)[0] for f in found] for m in (1, None)]
        self.seen['angle'] = np.array([f[0] for f in found]), tolerance
        self.seen['angle_all'] = np.array([f.mean() for f in found]), tolerance
        self.seen['smallest'] = np.array(counts[0]), np.zeros((3, BINS))
        self.seen['all'] = np.array(counts[1]), np.zeros((3, BINS))
        # of both starts: centre, stable space; the centre and the null space
        self.seen['spaces_apart'] = np.zeros(3), np.array([2 * off[1], 2 * off[2], off[1]])

    def measure_growth(self, path, before, begin, end, length):
        """From an earlier time, at which vectors were known to `before`."""
        rate = np.log(path.grown[begin:end]).sum(0)[: self.n] / length
        rounding = sum(np.diag(path.added[k]) / path.grown[k] for k in range(begin, end))[: self.n]
        off = (rounding + before[: self.n] + self.turn) / length
        low, high = rate - off, rate + off
        self.seen['rate'] = rate, off
        self.judge('violated', (low[:-1], high[:-1]), (low[1:], high[1:]))
        least = [np.minimum.accumulate(bound)[:-1] for bound in (low, high)]
        most = [np.maximum.accumulate(bound[:0:-1])[::-1] for bound in (low, high)]
        self.judge('entangled', least, most)

    def judge(self, name, one, other):
        """Whether one is less than the other, each between two bounds; it may be open."""
        less, more = one[1] < other[0], one[0] > other[1]
        self.seen[name] = less.astype(float), 1.0 - (less | more)


# ---- what the core says -----------------------------------------------------------------------


class Scene:
    def __init__(self, said, walls):
        self.disks = Disks(said['box'][0], walls)
        self.subspaces = [list(map(int, row)) for row in said.get('subspace', [])]
        self.zero = 6 - 2 * sum(walls)


def told_by(*arguments):
    """Its scene, states, windows: {name: rows}."""
    command = [PROGRAM, *map(str, arguments)]
    told = subprocess.run(command, check=True, stdout=subprocess.PIPE, universal_newlines=True)
    parts, states = [{}], []
    for line in told.stdout.splitlines():
        name, *numbers = line.split()
        row = [float(number) for number in numbers]
        if name == 'window':
            parts.append({})
        if name != 'state':
            parts[-1].setdefault(name, []).append(row)
        elif not states or row[0] > states[-1][0]:
            states.append(row)
    return parts[0], np.array(states), parts[1:]


def looks_of(path, scene, end, window, sampling, n):
    """Of one window, the last one first, as the core goes."""

    def index(time):
        k = np.abs(path.times - time).argmin()
        assert abs(path.times[k] - time) < 1e-9
        return k

    late = np.argmax(path.times > end + TRANSIENT - 1e-6)
    points = [index(time) for time in np.arange(end - window, end + 1e-9, sampling)]
    faster = path.parts_of_faster(points[0], late)
    for begin, k in zip(points[-2::-1], points[::-1]):
        look = Look(path, scene, k, path.slower[k], faster[k], n)
        before = (path.slower[begin] + faster[begin]).sum(0)
        look.measure_growth(path, before, begin, k, sampling)
        yield look


class Covariant(unittest.TestCase):
    most = {}  # {name: [largest deviation of what is resolved, largest part of what is allowed]}

    @classmethod
    def tearDownClass(cls):
        for name, (off, part) in cls.most.items():
            print(f'{name:20} apart by up to {off:.1e}, {part:.1e} of what is allowed')

    def compare(self, name, core, values, tolerance):
        core, tolerance = np.reshape(core, values.shape), tolerance + 256 * EPS
        off = np.abs(core - values)
        resolved, closed = off[tolerance < RESOLVED], tolerance < 1
        part = (off / tolerance)[closed].max(initial=0)
        most = self.most.setdefault(name, [0.0, 0.0])
        self.most[name] = np.maximum(most, [resolved.max(initial=0), part])
        for k in map(tuple, np.argwhere(~(off <= tolerance))[:1]):
            self.fail(f'{name}{k}: {core[k]} is not {values[k]} +- {tolerance[k]:.2g}')

    def compare_window(self, said, looks):
        (_, count), *_ = said.pop('window')
        self.assertEqual(len(looks), count)
        for kinds in (('dq_', 'dp_'), ('frame_',)):  # a vector and its negative are the same
            names = [kind + 'coefficient' for kind in kinds if kind + 'coefficient.now' in said]
            sign = sum((said[name + '.now'] * looks[-1].seen[name][0]).sum(0) for name in names)
            for name in names:
                said[name + '.now'] *= np.sign(sign)
        for name, core in said.items():
            with self.subTest(name=name):
                seen, how = name.split('.')
                found = zip(*[look.seen[seen] for look in looks])
                self.compare(name, core, *MADE[how](*map(np.array, found)))

    def compare_run(self, path, scene, told, window, sampling, n):
        _, states, windows = told
        np.testing.assert_array_equal(states, path.told)
        self.assertEqual(len(windows), AVERAGED // window)
        looks = []
        for k, said in enumerate(windows):
            end = EQUILIBRATION + TRANSIENT + (k + 1) * window
            self.assertAlmostEqual(said['window'][0][0], end, delta=1e-9)
            looks += looks_of(path, scene, end, window, sampling, n)
            self.compare_window(said, looks)
        known = np.isfinite(looks[-1].turn).sum()
        self.assertGreater(3 * (looks[-1].turn < RESOLVED).sum(), known)

    def check(self, disks, walls, step, variants):
        density, path = 0.3 if any(walls) else 0.4, None
        for exponents, window, sampling in variants:
            asked = disks, density, *walls, exponents, step
            told = told_by(*asked, TRANSIENT, window, sampling, TRANSIENT + AVERAGED)
            if path is None:
                scene = Scene(told[0], walls)
                path = Path(scene.disks, told[1])
                self.assertLessEqual(path.worst.max(), 1)
            half = (path.n - scene.zero) // 2
            n = {POSITIVE: half, ALL: path.n, INDEPENDENT: path.n}.get(exponents, exponents)
            with self.subTest(disks=disks, walls=walls, exponents=exponents):
                self.compare_run(path, scene, told, window, sampling, n)

    def test_few_disks(self):
        for disks, wall in itertools.product((3, 4, 5, 6), (0, 1)):
            walls = wall, (wall + disks + 1) % 2  # each number and each kind twice
            variants = [(ALL, 4, 4), (INDEPENDENT, 4, 4), (2 * disks, 4, 4)]
            variants += [(ALL, 6, 2), (INDEPENDENT, 6, 2), (POSITIVE, 6, 2)]
            self.check(disks, walls, 0.5, variants)

    def test_longer_intervals(self):
        self.check(4, (0, 1), 1, [(INDEPENDENT, 4, 4), (ALL, 4, 4)])
        self.check(4, (1, 0), 2, [(ALL, 4, 4)])


if __name__ == '__main__':
    np.seterr(divide='ignore', invalid='ignore')  # pairs that never meet
    unittest.main(argv=sys.argv[:1], verbosity=2)
