"""Films from bags: what a frame knows, what is drawn of it, and the file read back."""

import json
import os
import re
import subprocess
import unittest
from unittest import mock

import numpy as np
import rosbag
import rospy
from matplotlib.colors import to_rgb
from hdlyap.msg import LpPhase, LpPhases, State

import hdlyap
import made
import made_fields
from bags import Bags, process, tool
from hdlyap.data import reader
from hdlyap.data.reader import RecordingError
from hdlyap.plots import frames, movie
from hdlyap.plots.figures import turning
from hdlyap.plots.figures.style import BLUE, VERMILION

VIEWER = os.path.join(made.SCRIPTS, '../src/viewer')
INFO = made.run_info()
TURN = 8.0  # time units that the LP mode takes
BEGIN, END, FIELD = 10.0, 18.0, 4.0  # a report each time unit, fields each FIELD
STEPS = [made.step(INFO, made.T, 1, 0, 36, 37), made.step(INFO, made.LP, 1, 0, 32, 35)]


def angle(time):
    return 2 * np.pi * (time - BEGIN) / TURN


def state(time):
    x, y, px, py = made_fields.disks(INFO)
    return State(
        run_id='one', sim_time=time, x=np.mod(x + 0.1 * time, INFO.box_x), y=y, px=px, py=py
    )


def phases(time):
    pair = LpPhase(
        step=1, nx=1, ny=0, index=32, a=np.cos(angle(time)), b=np.sin(angle(time)), omega=1.0
    )
    return LpPhases(run_id='one', sim_time=time, sample_time=time, phases=[pair])


def fields(time):
    """T stands; LP is cos along x, sin along y."""
    t, lp = (
        made_fields.mode_field(INFO, step, sim_time=time, index=step.first_index) for step in STEPS
    )
    t.x = lp.x = state(time).x
    t.dqx, t.dqy = np.zeros(20), np.cos(2 * np.pi * np.array(t.x) / INFO.box_x)
    lp.dqx, lp.dqy = np.full(20, np.cos(angle(time))), np.full(20, np.sin(angle(time)))
    return [t, lp]


def write(path, but=(), lp_from=BEGIN):
    """One topic after the other, as a recorder may write what a fast run says. The LP mode is found
    at that time."""
    times = np.arange(BEGIN, END + 0.5)
    messages = [('run_info', INFO)]
    messages += [('state', state(time)) for time in times]
    messages += [('steps', made.steps(STEPS, time)) for time in times]
    messages += [('lp_phases', phases(time)) for time in times]
    found = [field for time in times[:: int(FIELD)] for field in fields(time)]
    messages += [('fields', f) for f in found if f.kind == made.T or f.sim_time >= lp_from]
    with rosbag.Bag(path, 'w') as bag:
        for number, (topic, message) in enumerate(messages):
            if topic not in but:
                bag.write('/hdlyap/' + topic, message, rospy.Time(1, 1000 * number))


class Films(Bags):
    def setUp(self):
        super().setUp()
        self.bag = self.path()
        write(self.bag)


class Frames(Films):
    def test_unknown_mode(self):
        with self.assertRaisesRegex(
            RecordingError, r'T\(9,9\) is not resolved in it, only T\(1,0\), LP\(1,0\)'
        ):
            frames.Film(hdlyap.load(self.bag), ['T(9,9)'])

    def test_begins_when_all_modes_are_found(self):
        write(self.bag, lp_from=BEGIN + FIELD)
        film = frames.Film(hdlyap.load(self.bag))
        self.assertEqual((film.begin, film.end), (BEGIN + FIELD, END))
        self.assertEqual(set(next(film.frames(1.0)).fields), {'T(1,0)', 'LP(1,0)'})

    def test_what_is_known_at_a_time(self):
        """Disks of each report; vectors of the last field, and phases of the report."""
        film = frames.Film(hdlyap.load(self.bag))
        self.assertEqual(film.names, ['T(1,0)', 'LP(1,0)'])
        self.assertEqual((film.begin, film.end), (BEGIN, END))
        self.assertEqual((film.report, film.field_interval), (1.0, FIELD))
        self.assertEqual(film.count(1.0), 9)
        for number, frame in enumerate(film.frames(1.0)):
            time = BEGIN + number
            of = BEGIN + FIELD * (number // int(FIELD))
            self.assertEqual(frame.time, time)
            np.testing.assert_array_equal(frame.places[0], state(time).x)
            for field, wanted in zip(map(frame.fields.get, film.names), fields(of)):
                self.assertEqual(field.sim_time, of)
                np.testing.assert_array_equal(field.dqy, wanted.dqy)
            lp = frame.fields['LP(1,0)']
            np.testing.assert_allclose(
                frame.pairs(lp), [(np.cos(angle(time)), np.sin(angle(time)))]
            )
            np.testing.assert_allclose(
                frame.turned['LP(1,0)'], [(np.cos(angle(of)), np.sin(angle(of)))]
            )
        self.assertEqual(number, 8)

    def test_phases_of_a_sample_before_the_field(self):
        """They are not those of its vectors."""
        frame, field, told = frames.Frame(INFO), fields(BEGIN)[1], phases(BEGIN)
        frame.add(reader.FIELD, field, ['LP(1,0)'])
        told.sample_time -= 0.5
        frame.add(reader.PHASES, told, ['LP(1,0)'])
        self.assertEqual(frame.turned, {})
        frame.add(reader.PHASES, phases(BEGIN), ['LP(1,0)'])
        self.assertEqual(len(frame.turned['LP(1,0)']), 1)

    def test_film_without_end(self):
        with self.assertRaisesRegex(RecordingError, r'in 8e\+09 frames: must be less than'):
            frames.Film(hdlyap.load(self.bag)).count(1e-9)

    def test_between_two_reports(self):
        """What is known then: the report before."""
        times = [frame.time for frame in frames.Film(hdlyap.load(self.bag)).frames(0.5)]
        self.assertEqual(times, [BEGIN + k // 2 for k in range(17)])

    def test_without_states(self):
        write(self.bag, but=('state',))
        self.assertEqual(
            [frame.time for frame in frames.Film(hdlyap.load(self.bag)).frames(FIELD)],
            [10.0, 14.0, 18.0],
        )


class Drawn(Films):
    def arrows(self, panel):
        return np.c_[panel._arrows.U, panel._arrows.V]

    def test_t_stands_and_lp_turns(self):
        film = frames.Film(hdlyap.load(self.bag))
        picture = movie.Picture(film, 400)
        t, lp = picture._panels
        drawn, colours, places = [], [], []
        for frame in film.frames(FIELD):
            picture.show(frame)
            drawn.append((self.arrows(t).copy(), self.arrows(lp).copy()))
            colours.append(lp._arrows.get_facecolor()[0][:3])
            places.append(np.array(t._particles.disks[1.0].get_offsets()))
            for panel in (t, lp):  # an arrow's middle is at its disk
                middle = panel._arrows.get_offsets() + 0.5 * self.arrows(panel)
                np.testing.assert_allclose(middle, places[-1])
            pair = np.cos(angle(frame.time)), np.sin(angle(frame.time))
            (hand,) = (one.get_segments()[0] for one in lp._dials)
            np.testing.assert_allclose(hand, [(0, 0), pair])
        # half a turn between two of them
        np.testing.assert_allclose(drawn[1][1], -drawn[0][1], atol=1e-9)
        np.testing.assert_allclose(drawn[0][1][:, 1], 0, atol=1e-9)
        np.testing.assert_allclose(colours[0], movie.ALL_L, atol=1e-6)
        for frame, (arrows, _), place in zip(film.frames(FIELD), drawn, places):
            wanted = np.cos(2 * np.pi * place[:, 0] / INFO.box_x)
            self.assertGreater(np.corrcoef(arrows[:, 1], wanted)[0, 1], 0.999)
        self.assertGreater(abs(places[1] - places[0]).max(), 0.1)

    def test_says_of_which_time_a_vector_is(self):
        film = frames.Film(hdlyap.load(self.bag))
        picture = movie.Picture(film, 400)
        for frame, words in zip(film.frames(1.0), ('vector 36', 'vector 36 of $t=10.0$')):
            picture.show(frame)
            text = picture._panels[0]._title.get_text()
            self.assertTrue(text.startswith('T(1,0) ') and text.endswith(words), text)
            self.assertIn('(20)', text)  # the error of made.step
        self.assertIn('t=11.0', picture._title.get_text())

    def test_of_a_mode_without_a_vector(self):
        write(self.bag, but=('fields',))
        film = frames.Film(hdlyap.load(self.bag), ['T(1,0)'])
        picture = movie.Picture(film, 400)
        picture.show(next(film.frames(1.0)))
        self.assertEqual(picture._panels[0]._title.get_text(), 'T(1,0): not resolved yet')

    def test_tall_boxes(self):
        """The picture is at most about as tall as two are wide."""
        for tall in (20.0, 60.0, 1000.0):
            film = frames.Film(hdlyap.load(self.bag))
            film.info.box_x, film.info.box_y = 2.0, 2.0 * tall
            wide, high = movie.Picture(film, 1280).figure.get_size_inches()
            self.assertLess(high, 1.5 * wide)


class BesideTheViewer(unittest.TestCase):
    def said(self, names):
        """{name: numbers} of constants of the viewer."""
        with open(os.path.join(VIEWER, 'draw.c')) as source:
            text = source.read()
        found = {}
        for name in names:
            value = re.search(rf'\b{name} = {{?([-0-9.F,\s]+)', text).group(1)
            found[name] = np.array(re.findall(r'[0-9.]+', value), dtype=float)
        return found

    def test_panels_look_alike(self):
        """What both draw stands in two languages."""
        colours = dict(T=BLUE, LP=VERMILION, L=movie.ALL_L, P=movie.ALL_P, DISK=movie.DISK)
        colours.update(LEFT=turning.LEFT, RIGHT=turning.RIGHT)
        said = self.said(['PALETTE_' + name for name in colours])
        for name, colour in colours.items():
            np.testing.assert_allclose(
                said['PALETTE_' + name][:3], to_rgb(colour), atol=0.5 / 100, err_msg=name
            )
        said = self.said(['LONG', 'PALE', 'LONGEST', 'ARROW'])
        self.assertEqual((said['LONG'], said['PALE']), (movie.LONG, movie.PALE))
        self.assertEqual(said['LONGEST'], movie.LONGEST)
        self.assertEqual(said['LONGEST'] * said['ARROW'], movie.ARROW)


class Files(Films):
    def probe(self, path):
        """Number of frames, their size and rate."""
        said = self.ffmpeg('ffprobe', '-count_frames', '-show_streams', '-of', 'json', path)
        stream = json.loads(said)['streams'][0]
        return int(stream['nb_read_frames']), stream['width'], stream['r_frame_rate']

    def ffmpeg(self, *command):
        done = subprocess.run([*command, '-v', 'error'], check=True, capture_output=True)
        return done.stdout

    def test_read_back(self):
        part = '--begin', '12', '--end', '16.5', '--width', '320'
        for name, width, count, how, cut, times in (
            ('modes.mp4', 1280, 5, process, (), '10 to 18 in 1.0 s'),
            ('modes.gif', 480, 5, tool, (), '10 to 18 in 1.0 s'),
            ('part.gif', 320, 3, tool, part, '12 to 16.5 in 0.6 s'),
        ):
            path = os.path.join(self.folder, name)
            options = '--out', path, '--fps', '5', '--pace', '10', *cut
            text = self.succeeds('movie', self.bag, *options, how=how)
            self.assertEqual(self.probe(path), (count, width, '5/1'))
            self.assertIn(f'{name}: T(1,0) and LP(1,0) from t = {times}, {count} frames', text)
            raw = self.ffmpeg('ffmpeg', '-i', path, '-f', 'rawvideo', '-pix_fmt', 'rgb24', '-')
            shots = np.frombuffer(raw, np.uint8).reshape(count, -1).astype(int)
            self.assertGreater((abs(shots[1] - shots[0]) > 60).mean(), 0.005)  # it moves
            self.assertLess((shots[0] > 200).mean(), 0.98)  # something is drawn
        self.assertEqual(
            sorted(os.listdir(self.folder)), ['modes.gif', 'modes.mp4', 'part.gif', 'run.bag']
        )

    def test_what_is_refused(self):
        for args, words in (
            (('--out', 'modes.avi'), 'modes.avi: must end with .mp4 or .gif'),
            (('--pace', '0'), 'must be above 0'),
            (('--width', '5000'), '5000: must be 64 .. 4096'),
            (('--modes', 'Q(1,0)'), 'must be lowest or names'),
        ):
            done = tool('movie', self.bag, *args)
            self.assertEqual(done.status, 2)
            self.assertIn(words, done.error)
        out = '--out', os.path.join(self.folder, 'modes.mp4')
        with mock.patch.dict(os.environ, PATH=self.folder):
            self.refuses('hdlyap movie: there is no ffmpeg', 'movie', self.bag, *out)
        words = r'hdlyap movie: .*: from t = 19 to 18: must be forwards, and within 10 .. 18\n'
        self.refuses(words, 'movie', self.bag, '--begin', '19', *out)
        for but, words in (
            (('state', 'fields'), 'neither state nor fields'),
            (('steps',), 'no step is resolved'),
        ):
            write(self.bag, but=but)
            said = r'\Ahdlyap movie: %s: %s.*\n\Z' % (self.bag, words)
            self.refuses(said, 'movie', self.bag, *out)
        self.assertEqual(os.listdir(self.folder), ['run.bag'])
