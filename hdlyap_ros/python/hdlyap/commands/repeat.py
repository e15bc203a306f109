"""The scene file of a recorded run: with it the run can be repeated.

hdlyap repeat run.bag > again.yaml
roslaunch hdlyap run.launch scene:=again.yaml record:=true bag:=again.bag"""

from hdlyap.plots import repetition


FAULT = 1


def options(parser):
    parser.add_argument('bag', help='file recorded by rosbag')
    parser.add_argument('--node', metavar='NAME', help='which node, if several are in the bag')
    parser.add_argument(
        '--run', metavar='K', type=int, help='which of its runs, from 1, if there are several'
    )


def main(args):
    print(repetition.scene_file(repetition.chosen(args.bag, args.node, args.run)), end='')
    return 0
