# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Ground segmentation methods."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from flagstone import _core
from flagstone._points import PointsLike, columns_of
from flagstone.segmentation import Segmentation

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from flagstone.settings import PatchworkSettings, SurfaceSettings

SensorHeight = float | Literal["estimate", "track"]
Tilt = tuple[float, float, float] | Literal["off", "estimate"]


_DEFAULTS = {"sensor": None, "sensor_height": None, "tilt": None, "preset": "default", "config": None, "threads": 1}


class Segmenter:
    """A ground segmentation method. Create one with `Surface`, `Patchwork` or `make_segmenter`.

    Thread-safe: threads that share a segmenter take turns. `segment` releases the GIL, so use one segmenter per thread
    to segment several scans in parallel. After a fork, both the parent and the child may use the segmenter.

    A segmenter can be pickled. The pickle contains its arguments, but not its estimates from scans.
    """

    def __init__(
        self,
        method: str,
        *,
        sensor: str | os.PathLike[str] | None = None,
        sensor_height: SensorHeight | None = None,
        tilt: Tilt | None = None,
        preset: str = "default",
        config: str | os.PathLike[str] | None = None,
        threads: int = 1,
        **settings: Any,
    ) -> None:
        self._made_of: dict[str, Any] = {
            "sensor": sensor,
            "sensor_height": sensor_height,
            "tilt": tilt,
            "preset": preset,
            "config": config,
            "threads": threads,
            **settings,
        }
        self._method = method
        _check_types(sensor, sensor_height, tilt, preset, config, threads)
        self._core = _core.Segmenter(
            method=method,
            preset=preset,
            sensor="" if sensor is None else os.fspath(sensor),
            config_file="" if config is None else os.fspath(config),
            settings=settings,
            sensor_height=sensor_height,
            tilt=tilt,
            threads=threads,
        )

    def __repr__(self) -> str:
        made_by_name = type(self) is Segmenter
        arguments = [repr(self._method)] if made_by_name else []
        for name, value in self._made_of.items():
            if name not in _DEFAULTS or type(value) is not type(_DEFAULTS[name]) or value != _DEFAULTS[name]:
                arguments.append(f"{name}={value!r}")
        return f"{'make_segmenter' if made_by_name else type(self).__name__}({', '.join(arguments)})"

    def __reduce__(self) -> tuple[Any, ...]:
        return _remake, (self._method, self._made_of)

    @property
    def method(self) -> str:
        """Name of the method, as `make_segmenter` accepts it."""
        return self._method

    @property
    def settings(self) -> dict[str, Any]:
        """All settings with their values, in the tables that `flagstone config` prints."""
        return self._core.settings()

    def segment(self, points: PointsLike) -> Segmentation:
        """Labels every point of a scan.

        Args:
            points: (N, >=3) float32 or float64, with any strides: x, y, z in metres in the sensor frame, followed by
                any other columns. A NumPy array, or an object that supports DLPack or the buffer protocol, such as a
                torch or Open3D tensor in CPU memory. Structured arrays, data frames and PyArrow tables are read by
                their columns x, y and z. Organized clouds, (H, W, >=3) or (H, W) records, are read as H * W points,
                row by row. float32 input is zero-copy if the three columns have the same stride. Any value is allowed:
                points with NaN or infinity are labelled `invalid`. Clouds of
                `flagstone.ros.parse` are accepted too.

        Returns:
            The result; see `Segmentation`. The same points and settings always give bit-identical results, unless the
            segmenter estimates or tracks the mounting pose.

        Raises:
            TypeError: The points are not floats, or not in CPU memory.
            ValueError: The shape is not supported, a column is missing, or there are more than 2^32 - 1 points.
            MemoryError: There is not enough memory.

        Warns:
            UserWarning: More than 90 % of the points are out of range, so the scan may not be in metres. Issued once
                per segmenter.
        """
        result = self._core.segment_rows(points)  # the fast path: rows of float32
        if result is None:
            result = self._core.segment(*columns_of(points))
        return Segmentation(result, self._core.settings)

    def reset(self) -> None:
        """Discards the estimated mounting pose, the only state that a segmenter keeps between scans."""
        self._core.reset()


class Surface(Segmenter):
    """The default method, `surface`: one continuous ground surface, and labels by the height above it.

    It fits planes to square patches, merges the ground patches into one surface and refines the surface with the
    points. One set of settings works for every sensor. docs/explanation/surface.md describes the method.

    The result does not depend on the order of the points. If they are permuted, labels and heights are permuted in the
    same way, and patches and surface are bit-identical.
    """

    def __init__(
        self,
        *,
        sensor: str | os.PathLike[str] | None = None,
        sensor_height: SensorHeight | None = None,
        tilt: Tilt | None = None,
        config: str | os.PathLike[str] | None = None,
        threads: int = 1,
        **settings: Unpack[SurfaceSettings],
    ) -> None:
        """Creates a segmenter.

        Args:
            sensor: Sensor whose height and range to use: a name from `sensors()`, or the path of a .toml file.
            sensor_height: Height h_s of the sensor above the ground in metres, -100 to 100. "estimate" uses the first
                scan that determines it, "track" updates it with every scan. By default the height of the sensor, or
                1.73.
            tilt: Up direction (x, y, z) in the sensor frame, for a tilted sensor. "estimate" determines it from the
                scans, "off" (the default) uses the z axis.
            config: Path of a TOML file of settings, as `flagstone config --method surface` prints them.
            threads: Number of threads per scan, 1 to 1,024. The result does not depend on it.
            **settings: Settings by name, tables as dictionaries, for example `point={"margin": 0.2}`. They override
                `config`. See `SurfaceSettings`.

        Raises:
            TypeError: An argument has the wrong type.
            ValueError: A setting is unknown or out of range. The message names it, its value and the allowed range.
        """
        super().__init__(
            "surface",
            sensor=sensor,
            sensor_height=sensor_height,
            tilt=tilt,
            config=config,
            threads=threads,
            **settings,
        )


class Patchwork(Segmenter):
    """Patchwork: bins of concentric zones, with one plane and one ground likelihood per bin.

    Source: H. Lim, M. Oh, H. Myung, "Patchwork: Concentric Zone-based Region-wise Ground Segmentation with Ground
    Likelihood Estimation Using a 3D LiDAR Sensor", IEEE RA-L 6(4), 2021; sections III-B (zones, eqs. 2 and 3), III-C
    (planes, eqs. 4 to 6) and III-D (likelihood, eqs. 7 to 12).
    """

    def __init__(
        self,
        *,
        sensor: str | os.PathLike[str] | None = None,
        sensor_height: SensorHeight | None = None,
        tilt: Tilt | None = None,
        preset: str = "default",
        config: str | os.PathLike[str] | None = None,
        threads: int = 1,
        **settings: Unpack[PatchworkSettings],
    ) -> None:
        """Creates a segmenter.

        Args:
            sensor: Sensor to derive zones, field of view, ranges and margins from (docs/reference/sensors.md): a name
                from `sensors()`, or the path of a .toml file.
            sensor_height: Height h_s of the sensor above the ground in metres, -100 to 100. "estimate" uses the first
                scan that determines it, "track" updates it with every scan. By default the height of the sensor, or
                1.73.
            tilt: Up direction (x, y, z) in the sensor frame, for a tilted sensor. "estimate" determines it from the
                scans, "off" (the default) uses the z axis.
            preset: Settings to start from if there is no `sensor`: "default", the values that scored best; "paper",
                the equations and values as printed; "reference", the behaviour of the authors' public code.
            config: Path of a TOML file of settings, as `flagstone config --method patchwork` prints them.
            threads: Number of threads per scan, 1 to 1,024. The result does not depend on it.
            **settings: Settings by name, tables as dictionaries, for example `distance_margin=0.1` or
                `uprightness={"angle": 45}`. They override `config`. See `PatchworkSettings`.

        Raises:
            TypeError: An argument has the wrong type.
            ValueError: A setting is unknown or out of range. The message names it, its value and the allowed range.
        """
        super().__init__(
            "patchwork",
            sensor=sensor,
            sensor_height=sensor_height,
            tilt=tilt,
            preset=preset,
            config=config,
            threads=threads,
            **settings,
        )


def make_segmenter(
    name: str = "surface",
    *,
    sensor: str | os.PathLike[str] | None = None,
    sensor_height: SensorHeight | None = None,
    tilt: Tilt | None = None,
    preset: str = "default",
    config: str | os.PathLike[str] | None = None,
    threads: int = 1,
    **settings: Any,
) -> Segmenter:
    """Creates a segmenter by the name of its method, for example to compare methods.

    Args:
        name: A name from `method_names()`.
        sensor: As for `Surface` and `Patchwork`. For other methods it sets the height, for `cascaded` also the beams.
        sensor_height: As for `Surface`.
        tilt: As for `Surface`.
        preset: As for `Patchwork`; only for `patchwork` and the methods `czm+...`.
        config: As for `Surface`, with settings of this method.
        threads: As for `Surface`; must be 1 for all methods except `surface` and `patchwork`.
        **settings: As for `Surface`, with settings of this method.

    Returns:
        A `Surface` or `Patchwork` for these two names, otherwise a `Segmenter`.

    Raises:
        TypeError: An argument has the wrong type.
        ValueError: The method or a setting is unknown, or a value is out of range. The message lists valid values.
    """
    made_of: dict[str, Any] = {
        "sensor": sensor,
        "sensor_height": sensor_height,
        "tilt": tilt,
        "preset": preset,
        "config": config,
        "threads": threads,
        **settings,
    }
    return _remake(name, made_of)


def _remake(name: str, made_of: dict[str, Any]) -> Segmenter:
    if name == "patchwork":
        return Patchwork(**made_of)
    segmenter = Surface.__new__(Surface) if name == "surface" else Segmenter.__new__(Segmenter)
    Segmenter.__init__(segmenter, name, **made_of)
    return segmenter


class _SegmenterWithSettings(Segmenter):
    """Made from all settings. Argument `sensor_height` would fix a height that the settings estimate."""

    def __init__(self, method: str, settings: dict[str, Any]) -> None:
        self._method = method
        self._made_of = settings
        self._core = _core.Segmenter(
            method=method,
            preset="default",
            sensor="",
            config_file="",
            settings=settings,
            sensor_height=None,
            tilt=None,
            threads=1,
        )

    def __reduce__(self) -> tuple[Any, ...]:
        return _SegmenterWithSettings, (self._method, self._made_of)


def segmenter_with(method: str, settings: dict[str, Any]) -> Segmenter:
    """A segmenter with the same settings as another one, from its `method` and `settings`.

    It has one thread, and none of the estimates of the other segmenter.

    Raises:
        ValueError: The method or a setting is unknown, or a value is out of range.
    """
    return _SegmenterWithSettings(method, settings)


def method_names() -> tuple[str, ...]:
    """Names that `make_segmenter` accepts, in the order of Table I of the paper, followed by `surface`."""
    return tuple(_core.method_names())


def _check_types(
    sensor: object, sensor_height: object, tilt: object, preset: object, config: object, threads: object
) -> None:
    """Raises a one-line TypeError if an argument has the wrong type. The compiled module checks the values."""
    for name, value, fits, expected in (
        ("sensor", sensor, sensor is None or isinstance(sensor, (str, os.PathLike)), "a name or path"),
        ("sensor_height", sensor_height, _is_height(sensor_height), 'a number, "estimate" or "track"'),
        ("tilt", tilt, _is_tilt(tilt), 'three numbers (x, y, z), "estimate" or "off"'),
        ("preset", preset, isinstance(preset, str), "a name"),
        ("config", config, config is None or isinstance(config, (str, os.PathLike)), "a path"),
        ("threads", threads, isinstance(threads, (int, np.integer)), "an integer"),
    ):
        if not fits:
            raise TypeError(f"{name}: {value!r} has the wrong type (expected {expected})")


def _is_height(value: object) -> bool:
    return value is None or isinstance(value, (str, int, float, np.integer, np.floating))


def _is_tilt(value: object) -> bool:
    if value is None or isinstance(value, str):
        return True
    return isinstance(value, (Sequence, np.ndarray)) and len(value) == 3 and all(map(_is_height, value))
