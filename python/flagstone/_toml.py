# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Settings as the text that the compiled part reads, so that they are named and checked in one place."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np


def to_toml(settings: Mapping[str, Any]) -> str:
    """TOML with a line a setting; tables in it are inline.

    Raises:
        TypeError: A value is neither number, truth value, text, sequence nor mapping.
    """
    return "".join(f"{_key(key)} = {_value(key, value)}\n" for key, value in settings.items())


def _key(key: str) -> str:
    return json.dumps(key)


def _value(key: str, value: Any) -> str:
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return _number(float(value))
    if isinstance(value, str):
        return json.dumps(value)
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_key(k)} = {_value(f'{key}.{k}', v)}" for k, v in value.items()) + "}"
    if isinstance(value, (Sequence, np.ndarray)):
        return "[" + ", ".join(_value(key, element) for element in value) + "]"
    raise TypeError(f"{key} is a {type(value).__name__}; settings are numbers, truth values, texts, lists and dicts")


def _number(value: float) -> str:
    if math.isnan(value):
        return "nan"
    if math.isinf(value):
        return "inf" if value > 0 else "-inf"
    return repr(value)
