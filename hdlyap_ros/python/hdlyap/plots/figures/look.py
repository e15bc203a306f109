"""Colours and settings of figures. Benchmarks and studies read this file where there is no ROS."""

# Okabe and Ito's palette, which colour-blind readers can distinguish
BLUE, ORANGE, GREEN, VERMILION, PURPLE, SKY = (
    '#0072B2',
    '#E69F00',
    '#009E73',
    '#D55E00',
    '#CC79A7',
    '#56B4E9',
)
GREY, LIGHT, INK = '#8C8C8C', '#C8C8C8', '#1A1A1A'
STYLE = {
    'font.size': 9,
    'axes.titlesize': 9,
    'axes.labelsize': 9,
    'legend.fontsize': 8,
    'xtick.labelsize': 8,
    'ytick.labelsize': 8,
    'xtick.direction': 'in',
    'ytick.direction': 'in',
    'xtick.top': True,
    'ytick.right': True,
    'axes.linewidth': 0.7,
    'lines.linewidth': 1.2,
    'legend.frameon': False,
    'mathtext.fontset': 'dejavusans',
    'svg.hashsalt': 'hdlyap',
}
# on top of it for a journal: letters of its size, which are no outlines, so that one can search
PAPER = {
    'font.family': 'STIXGeneral',
    'mathtext.fontset': 'stix',
    'font.size': 8,
    'axes.titlesize': 8,
    'axes.labelsize': 8,
    'legend.fontsize': 7,
    'xtick.labelsize': 7,
    'ytick.labelsize': 7,
    'axes.linewidth': 0.6,
    'lines.linewidth': 1.0,
    'pdf.fonttype': 42,
}
# of figures that have no page of ours
PLAIN = {**STYLE, 'lines.markersize': 4, 'figure.constrained_layout.use': True}
