#!/usr/bin/env python3
"""The real rviz, on a screen of its own without a monitor: it shows what ~markers says, where it
says so, live and to who comes late."""

import os
import signal
import time

import numpy as np
import rosgraph
import rospy
import yaml
from geometry_msgs.msg import Point
from std_srvs.srv import SetBool
from visualization_msgs.msg import Marker, MarkerArray

import harness
from hdlyap.commands import view as view_command
from screen import SIZE as SCREEN, Screen

VIEW = harness.command('view')
PAPER = (250, 251, 255)  # a background that nothing else has
# steps within seconds, then slow enough to look on
SCENE = dict(harness.MODES, warmup=40.0, duration=0.0, pace=2.0)


def config(folder, picture):
    """The view of a picture that is shipped, on a paper of its own."""
    view = view_command.shipped(picture)
    view['Visualization Manager']['Global Options']['Background Color'] = '%d; %d; %d' % PAPER
    view['Window Geometry'].update(Width=SCREEN[0], Height=SCREEN[1])
    path = os.path.join(folder, 'test.rviz')
    with open(path, 'w') as file:
        yaml.safe_dump(view, file)
    return path


class Paper:
    """Where the scene is on the screen: the view's middle is the paper's."""

    def __init__(self, shot, view):
        rows, columns = np.nonzero((shot == PAPER).all(axis=2))
        self.shot = shot
        self.middle = 0.5 * (columns.min() + columns.max()), 0.5 * (rows.min() + rows.max())
        self.view = view

    def pixels(self, x, y, around=0):
        """Colours at a place [sigma], and so many pixels around."""
        scale = self.view['Scale']
        column = self.middle[0] + (x - self.view['X']) * scale
        row = self.middle[1] - (y - self.view['Y']) * scale
        row, column = int(round(row)), int(round(column))
        return self.shot[
            row - around : row + around + 1, column - around : column + around + 1
        ].reshape(-1, 3)

    def has(self, x, y, colour, around=1, tolerance=45):
        wanted = 255 * np.array([colour.r, colour.g, colour.b])
        return bool((abs(self.pixels(x, y, around) - wanted).max(axis=1) <= tolerance).any())

    def is_inked(self, x, y, around):
        return bool((abs(self.pixels(x, y, around) - PAPER).max(axis=1) > 60).any())


def middles(marker):
    """Points that are well inside what a marker draws."""
    points = marker.points
    if marker.type == Marker.LINE_LIST:  # an arrow may lie on one of them
        return [
            (a.x + part * (b.x - a.x), a.y + part * (b.y - a.y))
            for a, b in zip(points[::2], points[1::2])
            for part in (0.2, 0.35, 0.5, 0.65, 0.8)
        ]
    if marker.type == Marker.TRIANGLE_LIST:  # heads of arrows: their shafts are a pixel wide
        heads = [points[k + 6 : k + 9] for k in range(0, len(points), 9)]
        return [(sum(p.x for p in head) / 3, sum(p.y for p in head) / 3) for head in heads]
    return [(p.x, p.y) for p in points]


def part_seen(paper, marker):
    """Of what a marker draws, the part that has its colour on the screen."""
    if (
        marker.type == Marker.TEXT_VIEW_FACING
    ):  # lines begin together: some may end before its middle
        place, lines = marker.pose.position, 1 + marker.text.count('\n')
        around = 0.6 * lines * marker.scale.z * paper.view['Scale']
        return float(paper.is_inked(place.x, place.y, int(around) + 1))
    places = middles(marker)
    colours = marker.colors or [marker.color] * len(places)
    if marker.type == Marker.SPHERE_LIST:  # shaded, and an arrow lies on their middle
        seen = [paper.is_inked(x + 0.3, y + 0.25, 1) for x, y in places]
    else:
        seen = [paper.has(x, y, colour) for (x, y), colour in zip(places, colours)]
    return sum(seen) / len(seen)


def drawn(picture):
    return [marker for marker in picture.markers if marker.action == Marker.ADD]


class Rviz(harness.Case):
    def setUp(self):
        self.folder = self.new_folder()
        self.screen = Screen()
        self.addCleanup(self.screen.close)
        self.pictures = self.hear('/hdlyap/markers', MarkerArray)

    def open_rviz(self):
        command = [*VIEW, '--config', config(self.folder, self.pictures[-1])]
        rviz = self.process(command, ROS_HOME=self.folder, **self.screen.env)
        self.sees(lambda: any(name.startswith('/rviz_') for name in self.subscribers()), rviz)
        with open(os.path.join(self.folder, 'view_hdlyap_markers.rviz')) as file:
            self.view = yaml.safe_load(file)['Visualization Manager']['Views']['Current']

    def subscribers(self):
        state = rosgraph.Master('/test').getSystemState()[1]
        return [name for topic, names in state if topic == '/hdlyap/markers' for name in names]

    def modes_seen(self):
        """Both modes in the newest picture."""
        drawn_now = drawn(self.pictures[-1]) if self.pictures else ()
        return len({m.ns for m in drawn_now if m.type == Marker.TRIANGLE_LIST}) == 2

    def pause(self, yes):
        self.assertTrue(harness.service('pause', SetBool)(yes).success)

    def missing(self, picture):
        """What the screen does not show of a picture: (namespace, type, part that is seen)."""
        shot = self.screen.shot()
        if not (shot == PAPER).all(axis=2).any():
            return ['rviz']  # is not there yet
        paper = Paper(shot, self.view)
        parts = [(m.ns, m.type, round(part_seen(paper, m), 2)) for m in drawn(picture)]
        return [part for part in parts if part[2] < 0.8]

    def check_shown(self, picture):
        self.assertTrue(
            harness.wait_until(lambda: not self.missing(picture), 20), self.missing(picture)
        )

    def rest(self):
        """Pauses the node, and returns its last picture."""
        self.pause(True)
        time.sleep(0.5)
        return self.pictures[-1]

    def test_late_and_live(self):
        viewer = harness.start_viewer()
        self.addCleanup(viewer.end)
        node = self.start(SCENE)
        self.sees(self.modes_seen, node)
        first = self.rest()
        self.open_rviz()  # late: nothing more is published
        self.check_shown(first)
        self.pause(False)  # live
        count = len(self.pictures)
        self.sees(lambda: len(self.pictures) > count + 20)
        self.check_shown(self.rest())
        self.assertTrue(self.missing(first), 'the picture does not change')


def seen_from(view, point):
    """Where a camera at the place of the view sees a point: right of its middle and above, as
    tangents of angles."""
    yaw, pitch = view['Yaw'], view['Pitch']
    away = np.array(
        [np.cos(yaw) * np.cos(pitch), np.sin(yaw) * np.cos(pitch), np.sin(pitch)]
    )  # from the focal point to the camera
    right = np.cross([0, 0, 1], away) / np.cos(pitch)
    camera = np.array([view['Focal Point'][axis] for axis in 'XYZ']) + view['Distance'] * away
    ray = np.array(point) - camera
    return np.array([ray @ right, ray @ np.cross(away, right)]) / -(ray @ away)


def box_of_spheres(size):
    """A picture of nothing but the edges of a box."""
    corners = [np.array([i, j, k]) for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    edges = [(a, b) for a in corners for b in corners if (b - a).sum() == abs(b - a).sum() == 1]
    marker = Marker(ns='box', type=Marker.LINE_LIST, action=Marker.ADD)
    marker.header.frame_id = 'world'
    marker.pose.orientation.w = marker.color.a = marker.color.r = 1.0
    marker.scale.x = 0.3
    marker.points = [Point(*(size * corner)) for edge in edges for corner in edge]
    return MarkerArray([marker])


class Spheres(harness.Case):
    SIZE = np.array([20.0, 6.0, 5.0])
    ROOM = SCREEN[0] - view_command.DOCK, SCREEN[1] - view_command.BARS

    def test_the_view_is_that_of_the_picture(self):
        """It can be turned where something is above the plane, and shows all of it; the other one
        is in rviz's list."""
        above, aside = 'rviz/TopDownOrtho', 'rviz/Orbit'
        picture = box_of_spheres(self.SIZE)
        for height, current, saved in ((0, above, aside), (1, aside, above)):
            shown = box_of_spheres(self.SIZE * [1, 1, height])
            views = view_command.shipped(shown)['Visualization Manager']['Views']
            self.assertEqual(views['Current']['Class'], current)
            self.assertEqual([view['Class'] for view in views['Saved']], [saved])
        for yaw, pitch in ((None, None), (0.3, 0.2), (-2.0, 1.4)):
            config = view_command.shipped(picture)
            view = config['Visualization Manager']['Views']['Current']
            self.assertEqual(view['Class'], aside)
            if yaw is not None:
                view.update(Yaw=yaw, Pitch=pitch)
            view_command.fitted(config, '/a/markers', picture)
            (display,) = config['Visualization Manager']['Displays']
            self.assertEqual(display['Marker Topic'], '/a/markers')
            edge = np.tan(np.radians(22.5)) * np.array([self.ROOM[0] / self.ROOM[1], 1])
            places = [
                abs(seen_from(view, (p.x, p.y, p.z))) / edge for p in picture.markers[0].points
            ]
            self.assertAlmostEqual(np.max(places), 1 / view_command.MARGIN, places=9)
            (flat,) = config['Visualization Manager']['Views']['Saved']
            self.assertEqual((flat['X'], flat['Y']), (10.0, 3.0))

    def test_rviz_shows_a_box_in_space(self):
        """Its edges are where the view says that they are."""
        folder, screen = self.new_folder(), Screen()
        self.addCleanup(screen.close)
        publisher = rospy.Publisher('/hdlyap/markers', MarkerArray, queue_size=1, latch=True)
        picture = box_of_spheres(self.SIZE)
        publisher.publish(picture)
        command = [*VIEW, '--config', config(folder, picture)]
        rviz = self.process(command, ROS_HOME=folder, **screen.env)
        self.sees(lambda: self.part_seen(folder, screen, picture) > 0.8, rviz)

    def part_seen(self, folder, screen, picture):
        """Of places on the edges."""
        shot = screen.shot()
        rows, columns = np.nonzero((shot == PAPER).all(axis=2))
        if not len(rows):
            return 0.0
        with open(os.path.join(folder, 'view_hdlyap_markers.rviz')) as file:
            view = yaml.safe_load(file)['Visualization Manager']['Views']['Current']
        middle = np.array([columns.min() + columns.max(), rows.min() + rows.max()]) / 2
        scale = 0.5 * (rows.max() - rows.min() + 1) / np.tan(np.radians(22.5))
        points = [np.array([p.x, p.y, p.z]) for p in picture.markers[0].points]
        seen = []
        for a, b in zip(points[::2], points[1::2]):
            for part in (0.2, 0.35, 0.5, 0.65, 0.8):
                x, y = seen_from(view, a + part * (b - a)) * scale
                column, row = int(round(middle[0] + x)), int(round(middle[1] - y))
                around = shot[row - 2 : row + 3, column - 2 : column + 3].reshape(-1, 3)
                seen.append(bool((around[:, 0] - around[:, 1] > 100).any()))  # red
        return sum(seen) / len(seen)


class View(harness.Case):
    def test_what_is_missing(self):
        """A configuration, a screen, a master."""
        no_file = "[Errno 2] No such file or directory: 'none.rviz'"
        for words, env, said in (
            ([*VIEW, '--config', 'none.rviz'], {}, no_file),
            (VIEW, {'DISPLAY': ''}, 'DISPLAY is not set: rviz needs a screen'),
        ):
            view = self.process(words, **env)
            self.assertEqual(view.wait(), 1)
            self.assertEqual(view.text().strip(), 'hdlyap view: ' + said)
        patient = dict(ROS_MASTER_URI='http://localhost:1', PYTHONUNBUFFERED='1', DISPLAY=':0')
        view = self.process(VIEW, **patient)
        self.sees(lambda: 'Will keep trying' in view.text(), view)
        view.send(signal.SIGINT)
        self.assertEqual(view.wait(), 130)
        self.assertNotIn('Traceback', view.text())


if __name__ == '__main__':
    harness.main('rviz')
