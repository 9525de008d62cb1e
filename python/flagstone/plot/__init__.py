# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Pictures on Matplotlib axes, in the look of the command's.

Text, lines and axes are vectors, points and shading are rasters, so that the PDF of a scan stays small.
"""

from flagstone.plot._birds_eye import birds_eye
from flagstone.plot._surface import surface

__all__ = ["birds_eye", "surface"]
