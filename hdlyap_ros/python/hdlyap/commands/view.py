"""rviz with the whole picture in its window, of a running node or of a bag that is played.

Waits for the first picture, fits rviz's view to it and becomes rviz."""

import glob
import math
import os
import sys
import threading

import rospkg
import rospy
import yaml
from visualization_msgs.msg import Marker, MarkerArray

from hdlyap.follow import nodes

DOCK, BARS = 380, 92  # pixels that the list of displays and the bars of the window take
MARGIN = 1.02
PERIOD = 0.5  # seconds between two looks whether there are pictures
LETTER, LINE = 0.5, 1.2  # width and height of rviz's letters over the height of a text
FIELD_OF_VIEW = math.radians(45)  # angle from the lower to the upper edge of rviz's picture


def first_picture(topic):
    """Waits for the first picture. Returns None if interrupted."""
    pictures, arrived = [], threading.Event()

    def keep(message):
        pictures.append(message)
        arrived.set()

    subscriber = rospy.Subscriber(topic, MarkerArray, keep, queue_size=1)
    if not arrived.wait(1.0):
        print(
            'hdlyap view: waiting for pictures on %s; rviz.launch starts their viewer' % topic,
            flush=True,
        )
    said = ''
    while not arrived.wait(PERIOD) and not rospy.is_shutdown():
        wrong = nodes.unheard_speaker(topic)
        if wrong and wrong != said:
            print('hdlyap view: ' + wrong, file=sys.stderr, flush=True)
            said = wrong
    subscriber.unregister()
    return pictures[0] if pictures else None


def shipped(picture):
    """The configuration of rviz in the package, installed or in its source. A picture in space gets
    the view that can be turned; the view from above is in rviz's list then."""
    share = rospkg.RosPack().get_path('hdlyap')
    installed, source = (
        os.path.join(share, *folders, 'rviz', 'hdlyap.rviz') for folders in ((), ('hdlyap_ros',))
    )
    config = configuration(installed if os.path.exists(installed) else source)
    views = config['Visualization Manager']['Views']
    above, (aside,) = views['Current'], views['Saved']
    if is_in_space(picture):
        views['Current'] = dict(aside, Name=above['Name'])
        views['Saved'] = [dict(above, Name='from above')]
    return config


def configuration(path):
    try:
        with open(path) as file:
            return yaml.safe_load(file)
    except (OSError, yaml.YAMLError) as error:
        sys.exit('hdlyap view: %s' % error)


def is_software_gl():
    """Whether the processor draws. Smooth edges would be most of the work then, and slow the
    run."""
    cards = '/dev/dri/*', '/dev/nvidia[0-9]*', '/dev/dxg'
    forced = os.environ.get('LIBGL_ALWAYS_SOFTWARE', '0').lower() in ('1', 'true')
    return forced or not any(map(glob.glob, cards))


def drawn(picture):
    return [marker for marker in picture.markers if marker.action == Marker.ADD]


def is_in_space(picture):
    """Whether a picture is in space, as of spheres; disks lie in a plane."""
    return any(point.z > 0 for marker in drawn(picture) for point in marker.points)


def places(picture):
    """The points (x, y, z) of all that is drawn, and the corners of texts."""
    found = [(point.x, point.y, point.z) for marker in drawn(picture) for point in marker.points]
    for marker in drawn(picture):
        if marker.type == Marker.TEXT_VIEW_FACING:
            lines, place = marker.text.split('\n'), marker.pose.position
            width = LETTER * max(map(len, lines)) * marker.scale.z
            for side in (-0.5, 0.5):
                height = side * LINE * len(lines) * marker.scale.z
                found.append((place.x + side * width, place.y + height, place.z))
    return found


def middle_and_size(numbers):
    low, high = min(numbers), max(numbers)
    return 0.5 * (low + high), high - low


def from_above(view, room, points):
    """Fits a view from above to all of a plane picture."""
    (x, width), (y, height), _ = map(middle_and_size, zip(*points))
    scale = min(room[0] / (MARGIN * width), room[1] / (MARGIN * height))
    view.update(X=x, Y=y, Scale=scale)


def seen(view, point):
    """How far a point is to the right of the focal point, above it, and nearer than it, as one
    looks from the direction of the view."""
    yaw, pitch = view['Yaw'], view['Pitch']
    x, y, z = (p - view['Focal Point'][axis] for p, axis in zip(point, 'XYZ'))
    out = x * math.cos(yaw) + y * math.sin(yaw)  # distance from the focal point, in the plane
    return (
        y * math.cos(yaw) - x * math.sin(yaw),
        z * math.cos(pitch) - out * math.sin(pitch),
        z * math.sin(pitch) + out * math.cos(pitch),
    )


def from_aside(view, room, points):
    """Fits a view to all of a picture in space. Its direction stays."""
    middle = [middle_and_size(numbers)[0] for numbers in zip(*points)]
    view['Focal Point'].update(zip('XYZ', middle))
    up = math.tan(0.5 * FIELD_OF_VIEW) / MARGIN
    right = up * room[0] / room[1]
    apparent = [seen(view, point) for point in points]
    view['Distance'] = max(near + max(abs(x) / right, abs(y) / up) for x, y, near in apparent)


def fitted(config, topic, picture):
    """The configuration of rviz with this topic, whose views show all of the picture."""
    manager, window = config['Visualization Manager'], config['Window Geometry']
    room = window['Width'] - DOCK, window['Height'] - BARS
    for display in manager['Displays']:
        if display['Class'] == 'rviz/MarkerArray':
            display['Marker Topic'] = topic
    views = manager['Views']
    for view in (views['Current'], *(views.get('Saved') or ())):
        fit = from_aside if view['Class'] == 'rviz/Orbit' else from_above
        fit(view, room, places(picture))
    return config


def options(parser):
    parser.add_argument('--node', default='/hdlyap', metavar='NAME', help='default: %(default)s')
    text = 'a view of your own instead of rviz/hdlyap.rviz'
    parser.add_argument('--config', metavar='FILE', help=text)


def main(args):
    config = configuration(args.config) if args.config else None
    if not (os.environ.get('DISPLAY') or os.environ.get('WAYLAND_DISPLAY')):
        sys.exit('hdlyap view: DISPLAY is not set: rviz needs a screen')
    try:
        rospy.init_node('view', anonymous=True)
    except rospy.ROSInitException:  # interrupted while there was no master
        return 130
    topic = rospy.resolve_name(args.node.rstrip('/')) + '/markers'
    picture = first_picture(topic)
    if picture is None:
        return 130
    config = config or shipped(picture)
    own = os.path.join(rospkg.get_ros_home(), 'view' + topic.replace('/', '_') + '.rviz')
    with open(own, 'w') as file:
        yaml.safe_dump(fitted(config, topic, picture), file)
    rospy.signal_shutdown('becomes rviz')
    try:
        plain = ['--disable-anti-aliasing'] if is_software_gl() else []
        os.execvp('rviz', ['rviz', '-d', own, *plain, '__name:=rviz_' + str(os.getpid())])
    except FileNotFoundError:
        sys.exit(
            'hdlyap view: there is no rviz; install it (Debian: rviz, Noetic: ros-noetic-rviz)'
        )
