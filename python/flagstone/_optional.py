# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Packages that only some functions need."""

import importlib
from typing import Any


def needs(module: str, extra: str) -> Any:
    """The module, imported now.

    Raises:
        ImportError: It is not installed; names the extra that brings it.
    """
    try:
        return importlib.import_module(module)
    except ImportError as error:
        package = module.partition(".")[0]
        if error.name is not None and error.name.partition(".")[0] != package:
            raise
        raise ImportError(
            f"{package} is not installed, and is needed here: pip install 'flagstone[{extra}]'", name=package
        ) from error
