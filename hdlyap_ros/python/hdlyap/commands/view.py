"""rviz with the whole picture in its window: of a running node, or of a bag that is played.

Waits for the first picture, fits rviz's view to it and becomes rviz."""

import glob
import os
import sys
import threading

import rospkg
import rospy
import yaml
from visualization_msgs.msg import Marker, MarkerArray

DOCK, BARS = 380, 92  # pixels of the window beside the picture: its list of displays, its bars
MARGIN = 1.02
LETTER, LINE = 0.5, 1.2  # width and height of rviz's letters, as parts of a text's height
# A drag with the left button adds to the angle of rviz's view, a 32-bit float, which would turn the
# picture but not its text. To so large an angle nothing can be added; it is none but for 2e-7.
LOCKED = 1111175296


def first_picture(topic):
    """Waits for it; None if interrupted."""
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
    while not arrived.wait(0.2) and not rospy.is_shutdown():
        pass
    subscriber.unregister()
    return pictures[0] if pictures else None


def shipped():
    """rviz's configuration, in an installed package or in its source."""
    share = rospkg.RosPack().get_path('hdlyap')
    installed = os.path.join(share, 'rviz', 'hdlyap.rviz')
    return (
        installed
        if os.path.exists(installed)
        else os.path.join(share, 'hdlyap_ros', 'rviz', 'hdlyap.rviz')
    )


def is_software_gl():
    """The processor draws: smooth edges would be most of its work, at the cost of the run's."""
    cards = '/dev/dri/*', '/dev/nvidia[0-9]*', '/dev/dxg'
    forced = os.environ.get('LIBGL_ALWAYS_SOFTWARE', '0').lower() in ('1', 'true')
    return forced or not any(map(glob.glob, cards))


def bounds(picture):
    """Corners of all that is drawn: (x, y) least and most."""
    drawn = [marker for marker in picture.markers if marker.action == Marker.ADD]
    places = [(point.x, point.y) for marker in drawn for point in marker.points]
    for marker in drawn:
        if marker.type == Marker.TEXT_VIEW_FACING:
            lines, place = marker.text.split('\n'), marker.pose.position
            width = LETTER * max(map(len, lines)) * marker.scale.z
            for side in (-0.5, 0.5):
                height = side * LINE * len(lines) * marker.scale.z
                places.append((place.x + side * width, place.y + height))
    return tuple(map(min, zip(*places))), tuple(map(max, zip(*places)))


def fitted(config, topic, picture):
    """rviz's configuration with this topic, and its view on all of the picture."""
    low, high = bounds(picture)
    manager, window = config['Visualization Manager'], config['Window Geometry']
    room = window['Width'] - DOCK, window['Height'] - BARS
    for display in manager['Displays']:
        if display['Class'] == 'rviz/MarkerArray':
            display['Marker Topic'] = topic
    manager['Views']['Current'].update(
        X=0.5 * (low[0] + high[0]),
        Y=0.5 * (low[1] + high[1]),
        Angle=LOCKED,
        Scale=min(room[d] / (MARGIN * (high[d] - low[d])) for d in range(2)),
    )
    return config


def options(parser):
    parser.add_argument('--node', default='/hdlyap', metavar='NAME', help='default: %(default)s')
    parser.add_argument(
        '--config', metavar='FILE', help='a view of your own instead of rviz/hdlyap.rviz'
    )


def main(args):
    try:
        with open(args.config or shipped()) as file:
            config = yaml.safe_load(file)
    except (OSError, yaml.YAMLError) as error:
        sys.exit('hdlyap view: %s' % error)
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
