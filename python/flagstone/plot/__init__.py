# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Plots of scans and of the ground, on Matplotlib axes, in the style of the command's images.

Text, lines and axes are vector graphics. Points and shading are raster graphics, so PDF files stay small.
"""

from flagstone.plot._birds_eye import birds_eye
from flagstone.plot._surface import surface

__all__ = ["birds_eye", "surface"]
