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
"""Type of the elements of `Segmentation.patches`."""

_LABEL_NAMES = tuple(_core.label_names())


class Mount(NamedTuple):
    """How the sensor stands to the ground, as the scan was segmented with.

    A point p of the scan lies at scale * p - origin metres from the sensor; turned the shortest way that brings `up`
    to z, that is its place in the level frame.
    """

    sensor_height: float
    """h_s: from the sensor down to the ground along `up`, metres."""
    up: tuple[float, float, float]
    """Where up is in the scan's frame."""
    origin: tuple[float, float, float]
    """Where the sensor is in the scan's frame, metres."""
    scale: float
    """Metres a unit of the scan."""
    decision: str
    """What the scan was found to say of it, in one sentence; of a given mount that it is given."""


class Segmentation:
    """Labels, heights, patches and surface of one scan of N points.

    Arrays are read-only views of memory that the result owns; they stay valid for as long as they, or the result, are
    held. Once nobody holds any of them, the memory serves a later scan of the same segmenter. Results can be pickled
    and copied; a copy has memory of its own.
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

        Of an organized cloud of shape (H, W) they go row by row: `labels.reshape(H, W)`.
        """
        return self._result.labels()

    @property
    def ground(self) -> npt.NDArray[np.bool_]:
        """(N,): whether each point is ground, in input order."""
        return self._result.ground()

    @property
    def heights(self) -> npt.NDArray[np.float32]:
        """(N,): height of each point above the ground below it, metres, in input order.

        NaN where no ground is known, and for points that are invalid or out of range. Methods that make no surface,
        `patchwork` among them, know none.
        """
        return self._result.heights()

    @property
    def patches(self) -> npt.NDArray[np.void]:
        """(P,): the bins S_n that hold points, with their planes and what was made of them; paper, III-B to III-D.

        Ordered by zone, ring and sector; those of `surface` nearest to the sensor first. Methods without patches have
        none. Fields:

        - `zone`, `ring`, `sector` (uint16): place in the zone model, from 0, the innermost; sectors counter-clockwise
          from the rear. Of `surface`: zone 0 are squares of 4 m, zone 1 of 8 m, ring the row, sector the column.
        - `verdict` (uint16): see `Verdict`. `point_count` |S_n|, `ground_count`, and of those
          `lower_ground_count`, below the plane in one of their own (uint32).
        - `mean` (3 float32), metres; `normal` (3 float32) n = v_3, unit length, upward, eq. (4); `d` (float32): the
          plane is normal . p + d = 0; `eigenvalues` (3 float32) of the covariance, descending, square metres. Zero
          where no plane was fitted.
        - `uprightness` phi, eq. (9); `elevation` psi, eq. (10); `flatness` varphi, eq. (11); `likelihood` f, their
          product, ground above 0.5, eqs. (8) and (12); `surface_variable` sigma, 0 to 1/3 (float32). Of `surface`
          they are zero.
        """
        return self._result.patches().view(PATCH_DTYPE)

    @cached_property
    def surface(self) -> GroundSurface:
        """The ground as one continuous surface; empty for methods that make none."""
        return GroundSurface(self._result)

    @property
    def counts(self) -> dict[str, int]:
        """Number of points by name of their label, all five; they add up to N."""
        return dict(zip(_LABEL_NAMES, self._result.counts(), strict=True))

    @property
    def mount(self) -> Mount:
        """How the sensor stands, as given or as found out from scans."""
        return Mount(*self._result.mount())

    @property
    def settings(self) -> dict[str, Any]:
        """Every setting the scan was segmented with, as `Segmenter.settings`: the zones of `patches` among them."""
        return self._settings()

    def to_pandas(self) -> pandas.DataFrame:
        """The patches as a data frame: a row a patch, a column a field.

        Vectors take three columns, `mean_x`, `normal_z`, `eigenvalue_1` and so on; `verdict` is a category by name.

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
