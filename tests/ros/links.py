"""Subscribers without rospy: bare connections to the node's topics, many of them in one process,
which are read as fast as they come, or not at all."""

import http.client
import selectors
import signal
import socket
import struct
import threading
import xmlrpc.client

import rosgraph

import harness

LENGTH = struct.Struct('<I')
CHUNK = 1 << 20


def answers(uri, pid):
    try:
        with xmlrpc.client.ServerProxy(uri) as proxy:
            return proxy.getPid('/links')[2] == pid
    except (OSError, http.client.HTTPException):  # one that ends, or whose port another has by now
        return False


def node_uri(node, master=None):
    """Of a node that has just been started: its name may still belong to the one before."""
    known = rosgraph.Master('/links', master)

    def found():
        try:
            uri = known.lookupNode('/' + harness.NODE)
        except (OSError, rosgraph.MasterError):
            return None
        return uri if answers(uri, node.process.pid) else None

    uri = harness.wait_until(lambda: found() or not node.running())
    assert isinstance(uri, str), node.text()
    return uri


def node_port(node, master=None):
    """Where the node takes subscribers, once its topics are there, the last of which is cost."""
    topic = '/%s/cost' % harness.NODE
    with xmlrpc.client.ServerProxy(node_uri(node, master)) as proxy:
        assert harness.wait_until(lambda: topic in dict(proxy.getPublications('/links')[2]))
        return proxy.requestTopic('/links', topic, [['TCPROS']])[2][2]


def pack(fields):
    """A connection header."""
    lines = [('%s=%s' % field).encode() for field in fields.items()]
    body = b''.join(LENGTH.pack(len(line)) + line for line in lines)
    return LENGTH.pack(len(body)) + body


NOWHERE = {}  # by name: with another address the master forgets what a node has registered before


def register(test, topic, name, uri=None):
    """As a subscriber, with the master alone, until the test ends, or the master."""
    master = rosgraph.Master(name, uri)
    nowhere = NOWHERE.setdefault(name, 'http://localhost:%d' % harness.free_port())
    full = '/%s/%s' % (harness.NODE, topic)
    master.registerSubscriber(full, harness.TYPES[topic]._type, nowhere)
    if uri is None:
        test.addCleanup(master.unregisterSubscriber, full, nowhere)


def end(stopped):
    """A subscriber that was stopped by a signal: so that the master does not keep it."""
    stopped.send(signal.SIGCONT)
    stopped.send(signal.SIGINT)
    stopped.wait()


class Link:
    """One subscriber of one topic. Of each message it keeps header.seq, which roscpp counts for
    each of them."""

    def __init__(self, port, topic, name='/links'):
        self.topic = topic
        self.seqs = []
        self.data = b''
        self.bytes = 0
        self.greeted = self.closed = False
        self.socket = socket.create_connection(('localhost', port))
        self.socket.sendall(
            pack(
                dict(
                    callerid=name,
                    topic='/%s/%s' % (harness.NODE, topic),
                    md5sum='*',
                    type='*',
                    tcp_nodelay='1',
                )
            )
        )

    def greet(self):
        """Waits until the node has answered."""
        while not self.greeted and not self.closed:
            self.read()
        assert self.greeted

    def read(self, most=CHUNK):
        some = self.socket.recv(most)
        self.closed = not some
        self.bytes += len(some)
        data, at = self.data + some, 0
        while len(data) >= at + LENGTH.size:
            end = at + LENGTH.size + LENGTH.unpack_from(data, at)[0]
            if len(data) < end:
                break
            if self.greeted:
                self.seqs.append(LENGTH.unpack_from(data, at + LENGTH.size)[0])
            elif data.startswith(b'error=', at + 2 * LENGTH.size):
                raise ConnectionError(data[at:end])
            self.greeted = True
            at = end
        self.data = data[at:]

    def gaps(self):
        """Messages lost between the first and the last."""
        return self.seqs[-1] - self.seqs[0] + 1 - len(self.seqs) if self.seqs else 0

    def close(self):
        self.socket.close()


class Reader(threading.Thread):
    """Reads links until the node closes them all."""

    def __init__(self, links):
        super().__init__(daemon=True)
        self.links = links
        self.start()

    def run(self):
        with selectors.DefaultSelector() as selector:
            for link in self.links:
                selector.register(link.socket, selectors.EVENT_READ, link)
            while selector.get_map():
                for key, _ in selector.select():
                    self.read(selector, key.data)

    def read(self, selector, link):
        try:
            link.read()
        except OSError:
            link.closed = True
        if link.closed:
            selector.unregister(link.socket)
