#!/usr/bin/env python3
"""Every message of an installed hdlyap: the same fields for rosmsg and in Python, the same sum in
C++.

messages.py PREFIX MESSAGE...
"""

import re
import sys

import rosmsg

import hdlyap.msg


def check(prefix, name):
    kind = getattr(hdlyap.msg, name)
    fields = ['%s %s' % field for field in zip(kind._slot_types, kind.__slots__)]
    # constants, and what a field consists of, are not its fields
    shown = [
        line
        for line in rosmsg.get_msg_text('hdlyap/' + name).splitlines()
        if re.match(r'\w[^=]*$', line)
    ]
    assert shown == fields, '%s: %s, not %s' % (name, shown, fields)
    with open('%s/include/hdlyap/%s.h' % (prefix, name)) as header:
        in_cpp = re.search(r'struct MD5Sum<.*?return "(\w{32})"', header.read(), re.DOTALL).group(1)
    assert kind._md5sum == in_cpp, name


if __name__ == '__main__':
    for message in sys.argv[2:]:
        check(sys.argv[1], message)
