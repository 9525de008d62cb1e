# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""`python -m flagstone` is the command `flagstone`."""

from flagstone._command import main

if __name__ == "__main__":
    main()
