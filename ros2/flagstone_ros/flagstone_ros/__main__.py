# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Runs the node: `python -m flagstone_ros`."""

import sys

from flagstone_ros.node import main

sys.exit(main())
