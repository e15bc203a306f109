#!/usr/bin/env python3
"""Whether what the comments of public functions call by name is there: a parameter of the function,
or something that the headers declare.

names.py FOLDER_OF_XML"""

import glob
import re
import sys
import xml.etree.ElementTree as ElementTree

# parameters: `name`, name[size], name may be NULL
PARAMETER = re.compile(r'`([a-z]\w*)`|\b([a-z]\w*)(?=\[\w)|\b([a-z]\w*)`?(?= may be NULL)')
# anything: name_of_words (neither /tf_static nor sum_k), HD_NAME (not HD_NAME_*)
NAME = re.compile(r'(?<![/\w])([a-z]\w*_[a-z]\w{2,})|\b(HDR?_\w*[A-Z0-9])\b')


def read(folder):
    """Root elements of the files that are about headers and structures."""
    for path in glob.glob(folder + '/*.xml'):
        yield ElementTree.parse(path).getroot()


def text(element):
    """With ` round what a comment marks as code."""
    own = (element.text or '') + ''.join(text(one) + (one.tail or '') for one in element)
    return f'`{own}`' if element.tag == 'computeroutput' else own


def comment(member):
    return ''.join(text(member.find(part)) for part in ('briefdescription', 'detaileddescription'))


def named(pattern, text):
    return {name for names in pattern.findall(text) for name in names if name}


def faults(member, declared):
    own, said = {name.text for name in member.iterfind('param/declname')}, comment(member)
    where = member.find('location')
    for name in sorted((named(PARAMETER, said) | named(NAME, said) - declared) - own):
        yield f'{where.get("file")}:{where.get("line")}: {member.findtext("name")}: no {name}'


def main():
    roots = list(read(sys.argv[1]))
    members = [member for root in roots for member in root.iter('memberdef')]
    declared = {one.text for root in roots for one in root.iter('name')}
    functions = [member for member in members if member.get('kind') == 'function']
    lines = [line for member in functions for line in faults(member, declared)]
    print(f'{len(functions)} functions', *lines, sep='\n')
    return 1 if lines or not functions else 0


if __name__ == '__main__':
    sys.exit(main())
