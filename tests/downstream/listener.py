#!/usr/bin/env python3
"""A node in Python: prints the exponents of one hdlyap/Spectrum and ends."""

import rospy

from hdlyap.msg import Spectrum

rospy.init_node('listener_py')
for exponent in rospy.wait_for_message('spectrum', Spectrum).exponents:
    print('%.3f' % exponent)
