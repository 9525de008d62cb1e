# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Runs the command `flagstone` for `python -m flagstone`."""

from flagstone._command import main

if __name__ == "__main__":
    main()
