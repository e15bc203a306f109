"""A look at the real rviz, on a screen of its own without a monitor: it shows what ~markers says,
live and to who comes late. Where things are, is in markers and view, as numbers."""

import os
import signal
import time

import numpy as np
import rosgraph
import yaml
from geometry_msgs.msg import Point
from std_srvs.srv import SetBool
from visualization_msgs.msg import Marker, MarkerArray

import harness
import pictured
from hdlyap.commands import view as view_command
from screen import SIZE as SCREEN, Screen

pytestmark = [harness.UNDER_A_MASTER, harness.SECOND_TIER]

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


def colours(picture):
    """Of lines and arrows: on the screen as they are, where spheres are shaded."""
    flat = Marker.LINE_LIST, Marker.TRIANGLE_LIST
    drawn = [m for m in picture.markers if m.action == Marker.ADD and m.type in flat]
    return {(m.color.r, m.color.g, m.color.b) for m in drawn}


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

    def subscribers(self):
        state = rosgraph.Master('/test').getSystemState()[1]
        return [name for topic, names in state if topic == '/hdlyap/markers' for name in names]

    def modes_seen(self):
        """Both modes in the newest picture."""
        return bool(self.pictures) and len(pictured.modes(self.pictures[-1])) == 2

    def pause(self, yes):
        self.assertTrue(harness.service('pause', SetBool)(yes).success)

    def shown(self, picture):
        """The screen, once it has the view's paper and every colour of a picture."""
        wanted = [PAPER, *(255 * np.array(one) for one in colours(picture))]

        def found():
            shot = self.screen.shot()
            near = [(abs(shot - one).max(axis=2) <= 45).any() for one in wanted]
            return (shot,) if all(near) else ()

        (shot,) = harness.wait_until(found, 20)
        return shot

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
        shot = self.shown(first)
        self.pause(False)  # live
        count = len(self.pictures)
        self.sees(lambda: len(self.pictures) > count + 20)
        moved = (self.shown(self.rest()) != shot).any(axis=2)
        self.assertGreater(moved.sum(), len(first.markers))


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
