#!/usr/bin/env python3
"""msg/*.msg -> the messages for C: a header of structs, and lists of fields for the wrapper.

What their comments say of fields is at hdlyap.data.fields; dimensions are out of DIMENSIONS.
The names of constants are hdr_MESSAGE_FIELD_text(value).

generate.py PACKAGE HEADER FIELDS MESSAGE_FILE...
"""

import os
import re
import sys

import genmsg

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, '..', 'python', 'hdlyap', 'data'))
import fields as read_fields  # noqa: E402, its package needs the messages

NUMBERS = {
    'bool': 'bool',
    'float32': 'float',
    'float64': 'double',
    'int8': 'int8_t',
    'int16': 'int16_t',
    'int32': 'int32_t',
    'int64': 'int64_t',
    'uint8': 'uint8_t',
    'uint16': 'uint16_t',
    'uint32': 'uint32_t',
    'uint64': 'uint64_t',
}
OTHERS = {'string': 'const char *', 'std_msgs/Header': 'hdr_header'}
ARRAYS = {
    'float64': 'hdr_doubles',
    'string': 'hdr_strings',
    'uint8': 'hdr_bytes',
    'uint32': 'hdr_uints',
    'uint64': 'hdr_counts',
}

DIMENSIONS = (
    'angle average bin coordinate corner growth_time kind modulation order pair particle phase '
)
DIMENSIONS += 'resolved response site step subspace t_phase transverse vector wave'
OF_PARTICLES = '@box', '@others', '@space', '@turning'  # what particles may have
WORDS = *OF_PARTICLES, '@fields', '@known'

HEADER = '''\
/** The messages of %(package)s, one struct each; made from msg/ at build time. Rules for all of
 * them are at RunInfo. Pointers point into buffers of the publisher, or into a received message.
 * Strings are never NULL. */
#ifndef HDLYAP_ROS_MESSAGES_H
#define HDLYAP_ROS_MESSAGES_H

#include "hdlyap_ros/fields.h"

#ifdef __cplusplus
extern "C" {
#endif

/** How many there are of each dimension of the arrays in messages, and which arrays there are. */
typedef struct hdr_lengths {
    double %(dimensions)s;
    bool box, others, space, turning;
} hdr_lengths;

/** Bytes of a message on the wire without texts: each time, and in addition when fields are due. */
typedef struct hdr_size {
    double always, fields;
} hdr_size;
%(structs)s
/** DO(struct) for each message with a header: those may have a topic. */
#define HDR_MESSAGES(DO) \\
%(topics)s

#ifdef __cplusplus
}
#endif
#endif
'''
CONSTANTS = '''
/** Constants of %(type)s. */
enum {
%(rows)s
};
'''
STRUCT = '''
/** %(type)s%(comment)s */
typedef struct %(name)s {
%(rows)s} %(name)s;
'''
TEXTS = '''
/** Name of a value of %(name)s.%(field)s. */
static inline const char *%(name)s_%(field)s_text(unsigned value)
{
    switch (value) {
%(rows)s
    default: return "unknown";
    }
}
'''
SIZE = '''
/** See hdr_size. */
static inline hdr_size %(name)s_size(const hdr_lengths *n)
{
    const hdr_size size = {%(always)s, %(fields)s};
    (void)n;
    return size;
}
'''
LIST = '''
/** %(type)s[] */
typedef struct %(name)s_list {
    const %(name)s *data;
    uint32_t count;
} %(name)s_list;
'''

FIELDS = '''\
/** The ROS type of each struct of hdlyap_ros/messages.h, and its fields in their order in the
 * message. Made from msg/ at build time. */
#pragma once

#include <cmath>

%(includes)s

#include "hdlyap_ros/messages.h"
#include "wrapper/serialise.hpp"

namespace hdlyap_ros
{
%(messages)s
} // namespace hdlyap_ros
'''
MESSAGE = '''
template <> struct message_of<%(name)s> {
    using type = %(cpp)s;
    template <class Stream, class Message> static void fields(Stream &s, Message &m)
    {
        pass(s, %(fields)s);
    }
};
'''
ITEM = '''
template <> struct item_of<%(name)s_list> {
    using type = %(name)s;
};
'''


def snake(name):
    return re.sub(r'(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])', '_', name).lower()


class Message:
    """One .msg file."""

    def __init__(self, package, path):
        self.short_name = os.path.splitext(os.path.basename(path))[0]
        self.type = package + '/' + self.short_name
        self.name = 'hdr_' + snake(self.short_name)
        self.spec = genmsg.msg_loader.load_msg_from_file(
            genmsg.MsgContext.create_default(), path, self.type
        )
        self.lines = self.spec.text.splitlines()
        self.fields = read_fields.parsed(self.spec.text)

    def uses(self, other):
        return any(field.base_type == other.type for field in self.spec.parsed_fields())

    def comment(self):
        """The comment of the message: the lines above its first constant or field."""
        text = ''
        for line in self.lines:
            if not line.startswith('#'):
                break
            text += '\n * ' + self.said(line.lstrip('# '))
        return ':' + text if text else ''

    def own_text(self, name):
        """The comment in the line of a field or a constant."""
        for line in self.lines:
            found = re.match(r'[\w/\[\]]+\s+%s\b[^#]*#\s*(.*)' % name, line)
            if found:
                return found.group(1)
        return ''

    def shape_of(self, name):
        """The names of an array's dimensions, and the words behind them."""
        dimensions, words = self.fields[name].shape, self.fields[name].only
        others = {one.partition('-')[0] for one in dimensions} - set(DIMENSIONS.split())
        others |= words - set(WORDS)
        if others:
            known = ', '.join([*DIMENSIONS.split(), *WORDS])
            sys.exit('%s: %s: %s: must be out of %s' % (self.type, name, ' '.join(others), known))
        return dimensions, words

    def comment_of(self, name):
        text = self.own_text(name)
        return ' /**< %s */' % self.said(text) if text else ''

    @staticmethod
    def said(text):
        """As a comment of C, and for doxygen, which has commands of its own."""
        return text.replace('*/', '* /').replace('@', r'\@')

    def constants(self):
        rows = []
        for constant in self.spec.constants:
            if constant.type not in NUMBERS or constant.type.startswith('float'):
                sys.exit('%s: %s: only integers are constants in C' % (self.type, constant.name))
            value = '%s = %d' % (self.c_constant(constant.name), constant.val)
            rows.append('    %s,%s' % (value, self.comment_of(constant.name)))
        return CONSTANTS % dict(type=self.type, rows='\n'.join(rows)) if rows else ''

    def c_constant(self, name):
        return ('HDR_%s_%s' % (snake(self.short_name), name)).upper()

    def texts(self):
        """A function for each field that holds one of some constants: their names."""
        text = ''
        for name in (name for name, field in self.fields.items() if field.choice):
            self.refuse_others(name, self.fields[name].choice)
            rows = [
                '    case %s: return "%s";' % (self.c_constant(constant), word)
                for constant, _, word in read_fields.choices(self.spec.text, name)
            ]
            text += TEXTS % dict(name=self.name, field=name, rows='\n'.join(rows))
        return text

    def refuse_others(self, name, constants):
        if not set(constants) <= {constant.name for constant in self.spec.constants}:
            sys.exit('%s: %s: one of %s .. %s: no such constants' % (self.type, name, *constants))

    def c_type(self, field, messages):
        if field.array_len is None:
            if field.is_array and field.base_type in ARRAYS:
                return ARRAYS[field.base_type]
            if not field.is_array and field.base_type in dict(NUMBERS, **OTHERS):
                return dict(NUMBERS, **OTHERS)[field.base_type]
            for other in messages:
                if other.type == field.base_type:
                    return other.name + ('_list' if field.is_array else '')
        sys.exit('%s: %s: C has nothing for %s' % (self.type, field.name, field.type))

    def struct(self, messages):
        rows = ''
        for field in self.spec.parsed_fields():
            c_type = self.c_type(field, messages)
            space = '' if c_type.endswith('*') else ' '
            rows += '    %s%s%s;%s\n' % (c_type, space, field.name, self.comment_of(field.name))
        return STRUCT % dict(vars(self), comment=self.comment(), rows=rows)

    def size(self, messages):
        """Bytes of fields. Arrays, strings and the name in a header begin with their length."""
        bytes_of = dict(bool=1, int8=1, uint8=1, int16=2, uint16=2, int32=4, uint32=4, float32=4)
        bytes_of.update({'int64': 8, 'uint64': 8, 'float64': 8, 'string': 4, 'std_msgs/Header': 16})
        names, fixed, sums = {one.type: one.name for one in messages}, 0, dict(always='', fields='')
        for field in self.spec.parsed_fields():
            fixed += 4 if field.is_array else bytes_of[field.base_type]
            dimensions, words = self.shape_of(field.name)
            if dimensions:
                one = names.get(field.base_type)
                each = one + '_size(n).always' if one else '%d.0' % bytes_of[field.base_type]
                factors = ['n->' + word[1:] for word in words if word in OF_PARTICLES]
                factors += ['(n->%s)' % word.replace('-', ' - ') for word in dimensions] + [each]
                sums['fields' if '@fields' in words else 'always'] += ' + ' + ' * '.join(factors)
        return SIZE % dict(
            name=self.name, always='%d.0' % fixed + sums['always'], fields='0.0' + sums['fields']
        )

    def is_in_arrays_of(self, messages):
        fields = [field for message in messages for field in message.spec.parsed_fields()]
        return any(field.is_array and field.base_type == self.type for field in fields)

    def value_of(self, word, messages):
        """The value of a number or a constant: of this message, or of the only one with it."""
        if re.fullmatch(r'-?\d+', word):
            return int(word)
        for some in ([self], messages):
            values = {c.val for one in some for c in one.spec.constants if c.name == word}
            if len(values) == 1:
                return values.pop()
        sys.exit('%s: %s: no constant, or more than one' % (self.type, word))

    def passed(self, field, messages):
        """The field as C++ passes it, with the value that is sent while it is not known."""
        name, of = 'm.' + field.name, self.fields[field.name]
        if field.base_type != 'float64':
            return name
        if not of.rule:
            return 'or_nan(%s)' % name if of.may_be_nan else name
        known, value = '!=' if of.rule.if_equal else '==', self.value_of(of.rule.value, messages)
        compared = 'm.%s %s %d' % (of.rule.field, known, value)
        unknown = 'NAN' if of.rule.sent == 'NaN' else '-1.0'
        return 'known_if(%s, %s, %s)' % (compared, name, unknown)

    def cpp_fields(self, messages):
        fields = (',\n' + 13 * ' ').join(
            self.passed(field, messages) for field in self.spec.parsed_fields()
        )
        cpp = self.type.replace('/', '::')
        return MESSAGE % dict(name=self.name, cpp=cpp, fields=fields)


def sorted_by_use(messages):
    """Sorts messages so that each one comes after those that it contains."""
    done = []
    while len(done) < len(messages):
        left = [message for message in messages if message not in done]
        done.append(next(one for one in left if not any(one.uses(other) for other in left)))
    return done


def header(package, messages):
    structs = ''
    for message in messages:
        structs += message.constants() + message.struct(messages)
        structs += message.texts() + message.size(messages)
        if message.is_in_arrays_of(messages):
            structs += LIST % vars(message)
    topics = ['    DO(%s)' % message.name for message in messages if message.spec.has_header()]
    return HEADER % dict(
        package=package,
        structs=structs,
        dimensions=', '.join(DIMENSIONS.split()),
        topics=' \\\n'.join(topics),
    )


def fields(messages):
    text = ''
    for message in messages:
        text += message.cpp_fields(messages)
        if message.is_in_arrays_of(messages):
            text += ITEM % vars(message)
    includes = ['#include <%s.h>' % message.type for message in messages]
    return FIELDS % dict(includes='\n'.join(sorted(includes)), messages=text)


def write(path, text):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, 'w') as file:
        file.write(text)


def main(package, header_path, fields_path, *paths):
    messages = sorted_by_use([Message(package, path) for path in sorted(paths)])
    write(header_path, header(package, messages))
    write(fields_path, fields(messages))


if __name__ == '__main__':
    main(*sys.argv[1:])
