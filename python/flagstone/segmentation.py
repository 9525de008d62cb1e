# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The result of segmenting one scan."""

from __future__ import annotations

import copy
from collections.abc import Callable
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from flagstone import _core
from flagstone._optional import needs
from flagstone.codes import Verdict
from flagstone.ground_surface import GroundSurface

if TYPE_CHECKING:
    import pandas


def _patch_dtype() -> np.dtype[np.void]:
    fields, size = _core.patch_fields()
    names, formats, offsets = zip(*fields, strict=True)
    return np.dtype({"names": list(names), "formats": list(formats), "offsets": list(offsets), "itemsize": size})


PATCH_DTYPE: np.dtype[np.void] = _patch_dtype()
"""dtype of `Segmentation.patches`."""

_LABEL_NAMES = tuple(_core.label_names())


class Mount(NamedTuple):
    """Mounting pose (height and tilt) of the sensor that a scan was segmented with: its extrinsic calibration.

    The position of a point p of the scan relative to the sensor is scale * p - origin, in metres. The shortest rotation
    that maps `up` to z transforms it to the level frame: origin at the sensor, z up.
    """

    sensor_height: float
    """h_s: height of the sensor above the ground along `up`, metres."""
    up: tuple[float, float, float]
    """Up direction in the frame of the scan."""
    origin: tuple[float, float, float]
    """Position of the sensor in the frame of the scan, metres."""
    scale: float
    """Metres per unit of the scan."""
    decision: str
    """How this pose was determined, in one sentence: configured, or estimated from scans."""


class Segmentation:
    """Labels, heights, patches and surface of one scan of N points.

    Arrays are read-only, zero-copy views of memory that the result owns. They stay valid as long as you keep a
    reference to them or to the result. Without references, a later scan of the same segmenter reuses the memory.

    Results can be pickled and copied; a copy has its own memory. Threads may share a result.
    """

    def __init__(self, result: _core.Result, settings: Callable[[], dict[str, Any]]) -> None:
        self._result = result
        self._settings = settings

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self._result.state(), self.settings)

    def __len__(self) -> int:
        """Number of points, N."""
        return sum(self._result.counts())

    def __repr__(self) -> str:
        counts = ", ".join(f"{count} {name}" for name, count in self.counts.items() if count)
        return f"Segmentation({len(self)} points: {counts or 'none'}; {len(self.patches)} patches)"

    @property
    def labels(self) -> npt.NDArray[np.uint8]:
        """(N,): code of each point, in input order; see `Label`.

        For an organized cloud, the order is row by row: `labels.reshape(H, W)`.
        """
        return self._result.labels()

    @property
    def ground(self) -> npt.NDArray[np.bool_]:
        """(N,): whether each point is ground, in input order."""
        return self._result.ground()

    @property
    def heights(self) -> npt.NDArray[np.float32]:
        """(N,): height of each point above the ground below it, in metres, in input order.

        NaN if the ground is unknown, and for points that are invalid or out of range. Methods without a surface, such
        as `patchwork`, do not compute heights: all are NaN.
        """
        return self._result.heights()

    @property
    def patches(self) -> npt.NDArray[np.void]:
        """(P,): the bins S_n that contain points, with plane and status; sections III-B to III-D of the paper.

        Patches of `patchwork` are ordered by zone, ring and sector, patches of `surface` by distance from the sensor.
        Methods without patches return an empty array. Fields:

        - `zone`, `ring`, `sector` (uint16): indices in the zone model, from 0. Zones and rings start at the sensor,
          sectors run counter-clockwise from the rear. For `surface`, zone 0 has squares of 4 m and zone 1 squares of
          8 m; `ring` is the row and `sector` the column.
        - `verdict` (uint16): see `Verdict`.
        - `point_count` |S_n| (uint32): number of points.
        - `ground_count` (uint32): number of ground points. For `surface` an estimate.
        - `lower_ground_count` (uint32): number of ground points below the plane that form a separate plane.
        - `mean` (3 float32): mean of the ground points, in the frame and units of the scan.
        - `normal` (3 float32): n = v_3, unit length, upward, eq. (4). With `d` (float32), the plane is
          normal . p + d = 0.
        - `eigenvalues` (3 float32): of the covariance, descending, square metres. `mean`, `normal`, `d` and
          `eigenvalues` are zero if no plane was fitted.
        - `uprightness` phi, eq. (9); `elevation` psi, eq. (10); `flatness` varphi, eq. (11) (float32).
        - `likelihood` f (float32): product of these three terms, above 0.5 for ground, eqs. (8) and (12).
        - `surface_variable` sigma (float32): 0 to 1/3. Like the likelihood and its terms, it is zero for `surface`.
        """
        return self._result.patches().view(PATCH_DTYPE)

    @cached_property
    def surface(self) -> GroundSurface:
        """The ground as one continuous surface; empty for methods that do not compute it."""
        return GroundSurface(self._result)

    @property
    def counts(self) -> dict[str, int]:
        """Number of points for each of the five label names; the numbers add up to N."""
        return dict(zip(_LABEL_NAMES, self._result.counts(), strict=True))

    @property
    def mount(self) -> Mount:
        """Mounting pose of the sensor, as configured or as estimated from scans."""
        return Mount(*self._result.mount())

    @property
    def settings(self) -> dict[str, Any]:
        """All settings that the scan was segmented with, like `Segmenter.settings`. They include the zones."""
        return self._settings()

    def to_pandas(self) -> pandas.DataFrame:
        """The patches as a data frame, with one row per patch and one column per field.

        Vectors are split into three columns: `mean_x`, `normal_z`, `eigenvalue_1` and so on. `verdict` is a categorical
        column of names.

        Raises:
            ImportError: pandas is not installed.
        """
        pd = needs("pandas", extra="pandas")
        patches = self.patches
        columns: dict[str, Any] = {}
        for name in PATCH_DTYPE.names or ():
            if name == "verdict":
                names = [verdict.name.lower() for verdict in Verdict]
                columns[name] = pd.Categorical.from_codes(patches[name].astype(np.int8), names)
            elif patches[name].ndim == 2:
                stem, ends = ("eigenvalue", "123") if name == "eigenvalues" else (name, "xyz")
                columns.update({f"{stem}_{end}": patches[name][:, i] for i, end in enumerate(ends)})
            else:
                columns[name] = patches[name]
        frame: pandas.DataFrame = pd.DataFrame(columns)
        return frame


def _restored(state: tuple[Any, ...], settings: dict[str, Any]) -> Segmentation:
    return Segmentation(_core.restored_result(*state), partial(copy.deepcopy, settings))
