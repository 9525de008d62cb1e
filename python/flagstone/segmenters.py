# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The methods: what turns points into labels."""

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
    """A ground segmentation method. Made by its class, `Surface` or `Patchwork`, or by name, `make_segmenter`.

    Threads may share one: their calls take turns, each with the interpreter's lock released. To work on several scans
    at once, give each thread a segmenter of its own. Segmenters can be pickled, which keeps how they were made, not
    what scans have told them. After a fork, parent and child may both use one.
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
        """Name of the method, as `make_segmenter` takes it."""
        return self._method

    @property
    def settings(self) -> dict[str, Any]:
        """Every setting with the value it has, in tables as in the file that `flagstone config` prints."""
        return self._core.settings()

    def segment(self, points: PointsLike) -> Segmentation:
        """Labels every point of a scan.

        Args:
            points: (N, >=3) float32 or float64: x, y, z in metres, then any other columns. Any strides; a NumPy array,
                or anything that supports DLPack or the buffer protocol (a torch or Open3D tensor of the CPU); or
                fields or columns named x, y and z: a structured array, a data frame, a PyArrow table. Organized
                clouds, (H, W, >=3) or (H, W) records, count as H * W points, row by row. float32 is read in place,
                without a copy. Any bit pattern is allowed: points that are not finite are labelled `invalid`.

        Returns:
            The result, whose arrays stay valid as long as they are held. The same points give the same bytes every
            time, but for segmenters that are told to estimate or track how the sensor stands.

        Raises:
            TypeError: The points are not floats, or not in the processor's memory.
            ValueError: Their shape is another, or they are more than 2^32 - 1.
            MemoryError: They are more than the memory holds.

        Warns:
            UserWarning: Nearly all points are out of range, once per segmenter: the scan may not be in metres.
        """
        result = self._core.segment_rows(points)  # the usual case
        if result is None:
            result = self._core.segment(*columns_of(points))
        return Segmentation(result, self._core.settings)

    def reset(self) -> None:
        """Forgets all scans: as newly made. Only how the sensor stands, where it is estimated, is ever remembered."""
        self._core.reset()


class Surface(Segmenter):
    """The method `surface`: planes of square patches, those that are ground joined to one continuous surface.

    The surface is refined where points say more, and every point judged by its height above it: docs/explanation/surface.md. One
    set of settings serves all sensors.
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
        """Makes a segmenter.

        Args:
            sensor: Whose height and range to use: a name that `sensors()` lists, or the path of a .toml file of your
                own.
            sensor_height: h_s, metres above the ground, -100 to 100; "estimate": from the first scan that tells it;
                "track": from every scan, smoothed. Without it the sensor's, or 1.73.
            tilt: Where up is in the sensor's frame, (x, y, z), for a sensor that leans; "estimate": from the scans;
                "off": along z.
            config: Path of a TOML file of settings, as `flagstone config --method surface` prints.
            threads: How many work on one scan together, 1 to 1,024; the result does not depend on it.
            **settings: Any setting of that file, tables as dictionaries: `point={"margin": 0.2}`.

        Raises:
            TypeError: An argument is of another type.
            ValueError: A setting is unknown or out of range; names it, its value and what is allowed.
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
    """Patchwork: concentric zones, a plane a patch, each judged by its ground likelihood.

    H. Lim, M. Oh, H. Myung, "Patchwork: Concentric Zone-based Region-wise Ground Segmentation with Ground Likelihood
    Estimation Using a 3D LiDAR Sensor", IEEE RA-L 6(4), 2021: sections III-B (zones, eqs. 2, 3), III-C (planes, eqs. 4
    to 6), III-D (likelihood, eqs. 7 to 12).
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
        """Makes a segmenter.

        Args:
            sensor: What to derive zones, field of view, ranges and margins from (docs/reference/sensors.md): a name that
                `sensors()` lists, or the path of a .toml file of your own.
            sensor_height: h_s, metres above the ground, -100 to 100; "estimate": from the first scan that tells it;
                "track": from every scan, smoothed. Without it the sensor's, or 1.73.
            tilt: Where up is in the sensor's frame, (x, y, z), for a sensor that leans; "estimate": from the scans;
                "off": along z.
            preset: Settings to start from where no sensor is named: "default", what measures best; "paper", the
                equations and numbers as printed; "reference", how the authors' public code behaves.
            config: Path of a TOML file of settings, as `flagstone config --method patchwork` prints.
            threads: How many work on one scan together, 1 to 1,024; the result does not depend on it.
            **settings: Any setting of that file, tables as dictionaries: `distance_margin=0.1`,
                `uprightness={"angle": 45}`.

        Raises:
            TypeError: An argument is of another type.
            ValueError: A setting is unknown or out of range; names it, its value and what is allowed.
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
    """A method by name, for comparisons and for names that come from files.

    Args:
        name: One of `method_names()`.
        sensor: As for `Surface` and `Patchwork`; of other methods it sets the height, of `cascaded` the beams too.
        sensor_height: As for `Surface`.
        tilt: As for `Surface`.
        preset: As for `Patchwork`; of `patchwork` and czm+... only.
        config: As for `Surface`, of this method.
        threads: As for `Surface`; 1 for all methods but `surface` and `patchwork`.
        **settings: As for `Surface`, of this method.

    Returns:
        `Surface` or `Patchwork` for those two names, else a `Segmenter`.

    Raises:
        TypeError: An argument is of another type.
        ValueError: There is no such method or setting, or a value is out of range; names what is allowed.
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


def method_names() -> tuple[str, ...]:
    """What `make_segmenter` knows, in the order of the paper's Table I, then `surface`."""
    return tuple(_core.method_names())


def _check_types(
    sensor: object, sensor_height: object, tilt: object, preset: object, config: object, threads: object
) -> None:
    """Raises TypeError, in one line, if an argument is of another type; values are checked by the compiled part."""
    for name, value, fits, wanted in (
        ("sensor", sensor, sensor is None or isinstance(sensor, (str, os.PathLike)), "a name or path"),
        ("sensor_height", sensor_height, _is_height(sensor_height), 'a number, "estimate" or "track"'),
        ("tilt", tilt, _is_tilt(tilt), 'three numbers (x, y, z), "estimate" or "off"'),
        ("preset", preset, isinstance(preset, str), "a name"),
        ("config", config, config is None or isinstance(config, (str, os.PathLike)), "a path"),
        ("threads", threads, isinstance(threads, (int, np.integer)), "a whole number"),
    ):
        if not fits:
            raise TypeError(f"{name} = {value!r} is not {wanted}")


def _is_height(value: object) -> bool:
    return value is None or isinstance(value, (str, int, float, np.integer, np.floating))


def _is_tilt(value: object) -> bool:
    if value is None or isinstance(value, str):
        return True
    return isinstance(value, (Sequence, np.ndarray)) and len(value) == 3 and all(map(_is_height, value))
