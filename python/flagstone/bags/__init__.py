# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Bag files of ROS 1 and ROS 2: the messages as bytes, without ROS.

`open_bag` reads ROS 1 bags (.bag, version 2.0), rosbag2 with SQLite (.db3) and MCAP (.mcap), as files or as directories
with metadata.yaml. `create_bag` writes them. Messages are not decoded: `flagstone.ros` reads the point clouds in them.
"""

from flagstone.bags.container import Bag, BagWriter, Compression, Format, Message, Topic, create_bag, open_bag

__all__ = ["Bag", "BagWriter", "Compression", "Format", "Message", "Topic", "create_bag", "open_bag"]
