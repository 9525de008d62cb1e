# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Optional packages, imported by the functions that need them."""

import importlib
from typing import Any


def needs(module: str, extra: str) -> Any:
    """Imports a module of an optional package.

    Raises:
        ImportError: The package is not installed. The message names the extra that installs it.
    """
    try:
        return importlib.import_module(module)
    except ImportError as error:
        package = module.partition(".")[0]
        if error.name is not None and error.name.partition(".")[0] != package:
            raise
        raise ImportError(
            f"{package} is not installed, but this function needs it: pip install 'flagstone[{extra}]'", name=package
        ) from error
