# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""F1 by scene and sensor: plain settings, the sensor's preset, and the preset with height and tilt estimated."""

from flagstone_runs import show_progress
from tables import percent, table
from worlds_scans import METHODS, SCENES, SENSORS, by_scene, simulate

LEAST = 0.90  # F1 below this is a shortfall
MOST_LOST = 0.005  # by estimating


def settings_of(sensor, height):
    """Options of `flagstone eval` by the name of a column."""
    return {
        "plain": f"--sensor-height {height:g}",
        "preset": f"--sensor {sensor}",
        "estimated": f"--sensor {sensor} --sensor-height estimate --tilt estimate",
    }


def measure_settings(runs):
    sensors = {}
    commands = []
    for sensor, height in SENSORS.items():
        simulate(runs, sensor, SCENES, f"worlds/{sensor}")
        sensors[sensor] = {}
        for name, options in settings_of(sensor, height).items():
            show_progress(f"{sensor}, {name}")
            command = f"flagstone eval $WORK/worlds/{sensor} --protocol patchwork++ {options}"
            result = runs.evaluate_command(f"{command} --methods {','.join(METHODS)}")
            commands.append(result["command"])
            sensors[sensor][name] = {method["name"]: by_scene(method) for method in result["methods"]}
    return {"sensors": sensors, "commands": commands}


def shown(value, is_short):
    return f"**{value}**" if is_short else value


def presets_table(results, method):
    """Rows of scenes, columns of sensors; each cell: plain, then preset."""
    rows = []
    for scene in SCENES:
        cells = []
        for sensor in SENSORS:
            plain = results["sensors"][sensor]["plain"][method][scene]
            preset = results["sensors"][sensor]["preset"][method][scene]
            cells.append(f"{percent(plain, 1)} → {shown(percent(preset, 1), preset < LEAST)}")
        rows.append([f"`{scene}`", *cells])
    rows.append(
        [
            "mean",
            *(
                f"{means(results, s, 'plain', method)} → {means(results, s, 'preset', method)}"
                for s in SENSORS
            ),
        ]
    )
    return table(["scene", *SENSORS], rows)


def means(results, sensor, name, method):
    values = results["sensors"][sensor][name][method]
    return percent(sum(values.values()) / len(values), 1)


def estimated_table(results, method):
    """What estimating height and tilt changes, points of F1."""
    rows = []
    for scene in SCENES:
        cells = []
        for sensor in SENSORS:
            of_sensor = results["sensors"][sensor]
            change = of_sensor["estimated"][method][scene] - of_sensor["preset"][method][scene]
            cells.append(shown(f"{round(100 * change, 2) + 0.0:+.2f}", change < -MOST_LOST))
        rows.append([f"`{scene}`", *cells])
    return table(["scene", *SENSORS], rows)


def shortfalls(results):
    """Where F1 with the preset is below LEAST, and where estimating costs more than MOST_LOST."""
    rows = []
    for method in METHODS:
        for scene in SCENES:
            for sensor in SENSORS:
                of_sensor = results["sensors"][sensor]
                plain, preset, estimated = (
                    of_sensor[name][method][scene] for name in ("plain", "preset", "estimated")
                )
                if preset >= LEAST and estimated >= preset - MOST_LOST:
                    continue
                rows.append(
                    [
                        f"`{method}`",
                        f"`{scene}`",
                        sensor,
                        *(percent(f1, 1) for f1 in (plain, preset, estimated)),
                    ]
                )
    return table(["method", "scene", "sensor", "plain", "preset", "estimated"], rows, left=3)


def settings_tables(results):
    found = {"shortfalls": shortfalls(results)}
    for method in METHODS:
        found[f"presets-{method}"] = presets_table(results, method)
        found[f"estimated-{method}"] = estimated_table(results, method)
    return found
