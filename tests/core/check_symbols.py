#!/usr/bin/python3
"""check_symbols.py LIBRARY FOLDER PREPROCESSOR...: what the library shows is what the headers in
the folder declare, all of it and nothing else."""

import glob
import re
import subprocess
import sys


def said(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def main():
    library, folder, *preprocessor = sys.argv[1:]
    headers = sorted(glob.glob(folder + '/hdlyap/*.h'))
    included = [text for header in headers for text in ('-include', header)]
    text = said(*preprocessor, '-E', *included, '-xc', '/dev/null')
    own = re.split(r'(?m)^# \d+ "(.*?)".*', text)[1:]  # a file, and what comes from it
    lines = ''.join(line for file, line in zip(own[::2], own[1::2]) if file.startswith(folder))
    declared = set(re.findall(r'\b(hd_\w+)\(', lines))
    shown = {line.split()[-1] for line in said('nm', '-D', '--defined-only', library).splitlines()}
    print(f'{len(declared)} declared, {len(shown)} shown')
    print(*(f'not shown: {name}' for name in sorted(declared - shown)), sep='\n')
    print(*(f'not declared: {name}' for name in sorted(shown - declared)), sep='\n')
    return declared != shown or not shown


if __name__ == '__main__':
    sys.exit(main())
