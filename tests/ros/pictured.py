"""What is in the pictures of the viewer."""

import numpy as np
import rospy
from visualization_msgs.msg import Marker, MarkerArray

from harness import MODES


class Pictures:
    """All pictures of a node, in the order of their arrival; those of a run of which only its
    description is known are in .empty."""

    def __init__(self, node='/hdlyap'):
        self.all, self.empty = [], []
        self.subscriber = rospy.Subscriber(
            node + '/markers', MarkerArray, self.keep, queue_size=None
        )

    def keep(self, picture):
        (self.all if of(picture, 'disks', Marker.SPHERE_LIST) else self.empty).append(picture)

    def close(self):
        self.subscriber.unregister()


def of(picture, ns, kind):
    return [m for m in picture.markers if m.ns == ns and m.type == kind and m.action == Marker.ADD]


def modes(picture):
    """Namespaces of the modes that are drawn."""
    return [
        m.ns for m in picture.markers if m.type == Marker.TRIANGLE_LIST and m.action == Marker.ADD
    ]


def text(picture):
    return of(picture, 'caption', Marker.TEXT_VIEW_FACING)[0].text


def places(picture):
    """Of the disks in the first panel."""
    points = of(picture, 'disks', Marker.SPHERE_LIST)[0].points
    return np.array([(p.x, p.y) for p in points[: MODES['number']]])


def lines(picture):
    """Points of the arrows of each mode, and of the phases."""
    return [
        np.array([(p.x, p.y) for p in marker.points])
        for ns, kind in [(ns, Marker.TRIANGLE_LIST) for ns in modes(picture)]
        + [('phases', Marker.LINE_LIST)]
        for marker in of(picture, ns, kind)
    ]


def are_alike(one, other):
    a, b = lines(one), lines(other)
    return (
        modes(one) == modes(other)
        and len(a) == len(b)
        and all(len(x) == len(y) and np.allclose(x, y, atol=1e-9) for x, y in zip(a, b))
    )
