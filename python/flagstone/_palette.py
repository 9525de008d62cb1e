# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Colours of plots and of the viewer. The images of the command use the same ones."""

from __future__ import annotations

from collections.abc import Mapping

from flagstone.codes import Label, Verdict

Color = tuple[int, int, int]
"""sRGB, each 0 to 255."""

# The panel is dark because the yellow and cyan of the paper's figures are too pale to read on white.
PANEL: Color = (16, 19, 24)
PANEL_TEXT: Color = (232, 236, 240)
RANGE_RING: Color = (150, 160, 172)
ZONE_LINE: Color = (235, 240, 245)
CONTOUR: Color = (88, 58, 38)

# Maps are on white, as their relief is light.
PAGE: Color = (255, 255, 255)
PATH: Color = (28, 62, 148)
NONMOVING: Color = (92, 100, 110)
MOVING: Color = (226, 36, 36)

# Yellow and cyan as in Fig. 7 of the paper.
LABELS: Mapping[Label, Color] = {
    Label.GROUND: (246, 201, 58),
    Label.NONGROUND: (58, 196, 226),
    Label.NOISE: (214, 104, 158),
    Label.OUT_OF_RANGE: (112, 121, 133),
    Label.INVALID: (112, 121, 133),
}

VERDICTS: Mapping[Verdict, Color] = {
    Verdict.GROUND: (0, 158, 115),
    Verdict.GROUND_FLAT: (166, 214, 42),
    Verdict.TOO_FEW_POINTS: (118, 126, 138),
    Verdict.NO_PLANE: (66, 110, 214),
    Verdict.NOT_UPRIGHT: (176, 92, 206),
    Verdict.TOO_HIGH: (226, 94, 30),
    Verdict.MIXED: (236, 160, 62),
    Verdict.OFF_SURFACE: (222, 70, 90),
}

TINT = 0.42
"""Opacity of the colour that tints a patch, 0 to 1."""


def in_words(member: Label | Verdict) -> str:
    """The name for a legend, for example "out of range"."""
    return "non-ground" if member is Label.NONGROUND else member.name.lower().replace("_", " ")


def rgb(color: Color) -> tuple[float, float, float]:
    """The colour for Matplotlib: red, green and blue, 0 to 1."""
    red, green, blue = color
    return red / 255, green / 255, blue / 255
