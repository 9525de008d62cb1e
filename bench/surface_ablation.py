# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""What `surface` loses without one of its parts, and what each setting does: differences in F1, scan by scan."""

from flagstone_runs import show_progress
from intervals import mean_of, paired
from surface_scans import per_scan
from tables import points_more, table, with_interval

# A part, and the settings that take it out; {margin} and the like stand for the settings' own values.
REMOVALS = [
    ("uprightness: patches up to 60° steep", ["acceptance.upright_angle=30"]),
    ("contrast of patches", ["acceptance.max_clutter_ratio=inf"]),
    ("cone", ["acceptance.max_height=1000"]),
    ("consistency with nearer patches", ["acceptance.max_step=inf"]),
    ("all refinement: the coarse surface alone", ["refinement.levels=0"]),
    ("cells of 1 m and less", ["refinement.levels=1"]),
    ("cells of 0.5 m and less", ["refinement.levels=2"]),
    ("cells of 0.25 m", ["refinement.levels=3"]),
    ("contrast of cells", ["refinement.max_clutter_ratio=inf"]),
    ("lower bound", ["refinement.lower_bound_weight=0"]),
    ("narrower gates on finer levels", ["refinement.gate_factor=1"]),
    ("smaller margin at obstacles", ["point.obstacle_margin={point.margin}"]),
    ("wider margin elsewhere", ["point.margin={point.obstacle_margin}"]),
    ("noise below the surface", ["point.noise_depth=1000"]),
]

# Settings are halved and doubled, but for these, which take other values.
OTHER_VALUES = {
    "max_range": (50, 80),
    "acceptance.upright_angle": (40, 60),
    "refinement.levels": (2, 3),
    "refinement.gate_factor": (0.5, 0.8),
}


def difference(study, names, settings):
    """F1 with settings less F1 without, over the scans of some sets."""
    changed = [result for name in names for result in study.evaluate(name, settings=settings)]
    before = [result for name in names for result in study.evaluate(name)]
    return paired(per_scan(changed, "surface"), per_scan(before, "surface"), "f1")


def level_of(study, name):
    """F1 of a set, mean over scans."""
    return mean_of([scan["f1"] for scan in per_scan(study.evaluate(name), "surface")["per_scan"]])


def measure_ablation(study):
    values = {key: value for key, (value, _) in study.surface_defaults().items()}
    rows = []
    for part, templates in REMOVALS:
        settings = [named(template, values) for template in templates]
        show_progress(f"ablation {len(rows) + 1} of {len(REMOVALS)}: {part}")
        rows.append(
            {
                "part": part,
                "settings": settings,
                "f1": {name: difference(study, [name], settings) for name in study.sets},
            }
        )
    return {"whole": {name: level_of(study, name) for name in study.sets}, "rows": rows}


def named(template, values):
    for key, value in values.items():
        template = template.replace(f"{{{key}}}", f"{value:g}")
    return template


def measure_settings(study):
    real = [name for name, scans in study.sets.items() if not scans.simulated]
    simulated = [name for name, scans in study.sets.items() if scans.simulated]
    rows = []
    defaults = study.surface_defaults()
    for key, (value, meaning) in defaults.items():
        show_progress(f"setting {len(rows) // 2 + 1} of {len(defaults)}: {key}")
        for other in OTHER_VALUES.get(key, (value / 2, value * 2)):
            settings = [f"{key}={other:g}"]
            f1 = {name: difference(study, [name], settings) for name in real}
            f1["simulated"] = difference(study, simulated, settings)
            rows.append({"setting": key, "meaning": meaning, "default": value, "value": other, "f1": f1})
    return {"rows": rows}


# --- tables ------------------------------------------------------------------------------------------------


def ablation_table(results, titles, simulated):
    """Over the real scans, or the simulated ones."""
    names = [name for name, scans in titles.items() if scans["simulated"] == simulated]
    whole = ["F1 of the whole method", "", *(with_interval(results["whole"][name]) for name in names)]
    rows = [
        [
            row["part"],
            " ".join(f"`{setting}`" for setting in row["settings"]),
            *(points_more(row["f1"][name]) for name in names),
        ]
        for row in results["rows"]
    ]
    head = ["without", "that is", *(titles[name]["title"] for name in names)]
    return table(head, [whole, *rows], left=2)


def settings_table(results):
    rows = {
        row["setting"]: [f"`{row['setting']}`", f"{row['default']:g}", row["meaning"]]
        for row in results["rows"]
    }
    return table(["setting", "default", "meaning; allowed values and unit"], rows.values(), left=3)


def effects_table(results, titles):
    names = [*(name for name, scans in titles.items() if not scans["simulated"]), "simulated"]
    rows = [
        [
            f"`{row['setting']}`",
            f"{row['default']:g} → {row['value']:g}",
            *(points_more(row["f1"][name]) for name in names),
        ]
        for row in results["rows"]
    ]
    head = ["setting", "changed", *(titles[name]["title"] for name in names[:-1]), "simulated"]
    return table(head, rows, left=2)
