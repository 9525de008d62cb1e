# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""ROS 2 node for flagstone: ground segmentation of point clouds."""
