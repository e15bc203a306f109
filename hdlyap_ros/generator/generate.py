#!/usr/bin/env python3
"""msg/*.msg -> the messages for C: a header of structs, and lists of fields for the wrapper.

The comment of a float64 says what is sent while its value is not known: 'NaN if FIELD is VALUE',
'NaN unless FIELD', or the same with -1. VALUE is a number or a constant (0 if there is none), and
'while' means 'if'. Otherwise the number must be finite. A comment with NaN but without such a rule
allows NaN at any time.

If a field has no comment, or only a unit ('# [sigma]') or a shape, the comment above it describes
it, too.

An array's comment ends with its shape: the names of its dimensions, out of DIMENSIONS, as in
{vector, particle}, from which sizes of messages follow. @space: it is empty in the plane; @turning:
unless particles turn; @fields: unless fields are due; @known: unless it is known at that time.

A field 'one of FIRST .. LAST' holds one of these constants. The text before the first colon in the
comment of a constant is its name: hdr_MESSAGE_FIELD_text(value) in C, hdlyap.data.fields.words in
Python.

generate.py PACKAGE HEADER FIELDS MESSAGE_FILE...
"""

import os
import re
import sys

import genmsg

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
    'angle bin corner growth_time modulation order pair particle phase resolved response site '
)
DIMENSIONS += 'step subspace t_phase transverse vector wave'
WORDS = '@space', '@turning', '@fields', '@known'

CHOICE = re.compile(r'one of (\w+) \.\. (\w+)')
SHAPE = re.compile(r'\s*\{(\w[^}]*)\}((?: @\w+)*)$')
UNKNOWN = re.compile(r'(NaN|-1) (if|while|unless) (\w+)(?: is (-?\w+))?')

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
    bool space, turning;
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
        self.names = [constant.name for constant in self.spec.constants] + self.spec.names

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
        found = SHAPE.search(self.own_text(name))
        dimensions, words = (
            [found.group(1).split(', '), found.group(2).split()] if found else [[], []]
        )
        others = {one.partition('-')[0] for one in dimensions} - set(DIMENSIONS.split())
        others |= set(words) - set(WORDS)
        if others:
            known = ', '.join([*DIMENSIONS.split(), *WORDS])
            sys.exit('%s: %s: %s: must be out of %s' % (self.type, name, ' '.join(others), known))
        return dimensions, words

    def text_of(self, name):
        """The text that describes a field or a constant: in its line or the nearest above."""
        names = self.names[: self.names.index(name) + 1]
        texts = (SHAPE.sub('', self.own_text(above)) for above in reversed(names))
        return next((text for text in texts if text and not text.startswith('[')), '')

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
        for field in self.spec.parsed_fields():
            choice = CHOICE.search(self.text_of(field.name))
            rows = [
                '    case %s: return "%s";'
                % (self.c_constant(name), self.text_of(name).partition(':')[0])
                for name in self.choices(*choice.groups() if choice else ())
            ]
            if rows:
                text += TEXTS % dict(name=self.name, field=field.name, rows='\n'.join(rows))
        return text

    def choices(self, first=None, last=None):
        """The names of the constants from one to another."""
        names = [constant.name for constant in self.spec.constants]
        if first and not {first, last} <= set(names):
            sys.exit('%s: one of %s .. %s: no such constants' % (self.type, first, last))
        return names[names.index(first) : names.index(last) + 1] if first else []

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
                factors = ['n->' + word[1:] for word in words if word in ('@space', '@turning')]
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
        text, name = self.text_of(field.name), 'm.' + field.name
        if field.base_type != 'float64':
            return name
        rule = UNKNOWN.search(text)
        if not rule or rule.group(3) not in self.spec.names:
            return 'or_nan(%s)' % name if 'NaN' in text else name
        unknown, how, other, word = rule.groups()
        equal = (how == 'unless') == (word is not None)  # a field alone means: it is not 0
        compared = 'm.%s %s %d' % (
            other,
            '==' if equal else '!=',
            self.value_of(word or '0', messages),
        )
        return 'known_if(%s, %s, %s)' % (compared, name, 'NAN' if unknown == 'NaN' else '-1.0')

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
